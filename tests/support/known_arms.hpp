// The bundled arm on its table, and two of them that reach one another.
#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth {

inline RobotSettings bundled_arm() {
  return {.urdf = BERTH_BUNDLED_ARM "/arm.urdf",
          .package_paths = {{"berth_arm", BERTH_BUNDLED_ARM}},
          .environment_links = {"table"}};
}

inline RobotSettings two_arms_in_two() {
  RobotSettings settings = bundled_arm();
  settings.others.push_back({.urdf = settings.urdf,
                             .package_paths = settings.package_paths,
                             .prefix = "second_",
                             .parent = "table",
                             .X_PR = Pose(Eigen::Translation3d(0.6, 0.1, 0))});
  settings.environment_links.push_back("second_table");
  return settings;
}

}  // namespace berth
