#include <fmt/format.h>

#include <cmath>

#include "lab/bundled_scene/arm_collision.hpp"
#include "lab/bundled_scene/output_files.hpp"
#include "sim/room.hpp"

namespace berth::lab {
namespace {

// Without the -0 and 1e-18 that rotations leave.
std::string numbers(const Eigen::Vector3d& v) {
  const auto clean = [](double x) { return std::round(x * 1e9) / 1e9 + 0.0; };
  return fmt::format("{:.10g} {:.10g} {:.10g}", clean(v.x()), clean(v.y()), clean(v.z()));
}

std::string origin(const Pose& X) {
  const Eigen::Vector3d rpy = X.linear().eulerAngles(2, 1, 0).reverse();
  return fmt::format(R"(<origin xyz="{}" rpy="{}"/>)", numbers(X.translation()), numbers(rpy));
}

std::string table_link() {
  std::string text = fmt::format("  <link name=\"{}\">\n", sim::kTableLink);
  for (const std::string tag : {"visual", "collision"})
    for (const sim::Box& box : sim::table_boxes())
      text += fmt::format(
          R"(    <{0}>{1}<geometry><box size="{2}"/></geometry></{0}>
)",
          tag, origin(Pose(Eigen::Translation3d(box.centre_T_m))), numbers(box.size_m));
  return text + "  </link>\n";
}

std::string collision(const CollisionShape& shape) {
  const std::string geometry = shape.length_m > 0
                                   ? fmt::format(R"(<cylinder radius="{:.6g}" length="{:.6g}"/>)",
                                                 shape.radius_m, shape.length_m)
                                   : fmt::format(R"(<sphere radius="{:.6g}"/>)", shape.radius_m);
  return fmt::format("    <collision>{}<geometry>{}</geometry></collision>\n", origin(shape.X_LS),
                     geometry);
}

std::string arm_link(int link) {
  const std::string name = sim::arm_link_name(link);
  std::string text = fmt::format(R"(  <link name="{0}">
    <visual><geometry><mesh filename="package://berth_arm/meshes/{0}.stl"/></geometry></visual>
)",
                                 name);
  for (const CollisionShape& shape : arm_collision(link)) text += collision(shape);
  return text + "  </link>\n";
}

std::string arm_joint(int index) {
  const sim::ArmJoint& joint = sim::arm_joints()[index];
  return fmt::format(R"(  <joint name="{}" type="revolute">
    <parent link="{}"/>
    <child link="{}"/>
    {}
    <axis xyz="{}"/>
    <limit lower="{:.6f}" upper="{:.6f}" effort="100" velocity="{:.6f}"/>
  </joint>
)",
                     sim::arm_joint_name(index), sim::arm_link_name(index),
                     sim::arm_link_name(index + 1),
                     origin(Pose(Eigen::Translation3d(joint.offset_m))), numbers(joint.axis),
                     -joint.limit_rad, joint.limit_rad, joint.velocity_rad_s);
}

}  // namespace

std::string arm_urdf() {
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- Made by lab/bundled_scene. Metres, radians. -->\n"
      "<robot name=\"berth_arm\">\n";
  text += table_link();
  text += fmt::format(R"(  <joint name="arm_mount" type="fixed">
    <parent link="{}"/>
    <child link="{}"/>
  </joint>
)",
                      sim::kTableLink, sim::arm_link_name(0));
  for (int link = 0; link < sim::kArmLinks; ++link) text += arm_link(link);
  for (int joint = 0; joint < sim::kArmJoints; ++joint) text += arm_joint(joint);
  return text + "</robot>\n";
}

}  // namespace berth::lab
