#include "berth/robot/robot_region.hpp"

#include "berth/robot/surface.hpp"

namespace berth {

RobotModel robot_region(const RobotModel& model, double scale) {
  RobotModel region = model;
  for (Link& link : region.links) {
    if (link.role == LinkRole::evaluated) {
      link.mesh_L = scaled(link.mesh_L, scale);
    } else {
      link.role = LinkRole::ignored;
    }
  }
  return region;
}

}  // namespace berth
