#include "lab/bench/coarse_robot.hpp"

#include "lab/bench/coarsen.hpp"
#include "lab/bench/subdivide.hpp"

namespace berth::lab {

constexpr float kCell_m = 0.02f;

RobotModel coarse_robot(RobotSettings robot, int parts) {
  robot.geometry = GeometryKind::collision;
  RobotModel model = load_robot(robot);
  for (Link& link : model.links) link.mesh_L = subdivide(coarsen(link.mesh_L, kCell_m), parts);
  return model;
}

}  // namespace berth::lab
