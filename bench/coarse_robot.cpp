#include "bench/coarse_robot.hpp"

#include "bench/coarsen.hpp"
#include "bench/subdivide.hpp"

namespace berth::bench {

constexpr float kCell_m = 0.02f;

RobotModel coarse_robot(RobotSettings robot, int parts) {
  robot.geometry = GeometryKind::collision;
  RobotModel model = load_robot(robot);
  for (Link& link : model.links) link.mesh_L = subdivide(coarsen(link.mesh_L, kCell_m), parts);
  return model;
}

}  // namespace berth::bench
