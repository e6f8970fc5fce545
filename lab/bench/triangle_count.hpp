#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth::lab {

inline std::size_t triangle_count(const RobotModel& model) {
  std::size_t count = 0;
  for (const Link& link : model.links) count += link.mesh_L.triangles.size();
  return count;
}

}  // namespace berth::lab
