// Small URDFs as text.
#pragma once

#include <string>

#include "berth/robot/robot_model.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {

inline std::string robot_xml(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"test\">\n" + inside + "\n</robot>\n";
}

inline std::string link_xml(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}

/// `geometry` is such as <box size="1 1 1"/>, `kind` visual or collision.
inline std::string shape_xml(const std::string& geometry, const std::string& origin = "",
                             const std::string& kind = "visual") {
  return "<" + kind + ">" + origin + "<geometry>" + geometry + "</geometry></" + kind + ">";
}

inline std::string box_link_xml(const std::string& name) {
  return link_xml(name, shape_xml(R"(<box size="1 1 1"/>)"));
}

/// Revolute and prismatic joints get the limit that URDF asks for.
inline std::string joint_xml(const std::string& name, const std::string& type,
                             const std::string& parent, const std::string& child,
                             const std::string& inside = "") {
  const bool limited = type == "revolute" || type == "prismatic";
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" +
         (limited ? "<limit lower=\"-9\" upper=\"9\" effort=\"1\" velocity=\"1\"/>" : "") + inside +
         "</joint>\n";
}

inline RobotModel load_text(const TemporaryFolder& folder, const std::string& xml,
                            RobotSettings settings = {}) {
  settings.urdf = folder.write("robot.urdf", xml);
  return load_robot(settings);
}

}  // namespace berth
