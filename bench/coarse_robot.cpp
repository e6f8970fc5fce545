#include "bench/coarse_robot.hpp"

#include "bench/coarsen.hpp"
#include "bench/subdivide.hpp"

namespace berth::bench {

constexpr float kCell_m = 0.02f;

RobotModel coarse_robot(const SceneRobot& robot, int parts) {
  RobotModel model = load_robot({robot.urdf, robot.package_paths, GeometryKind::collision,
                                 robot.environment_links, robot.ignore_links});
  for (Link& link : model.links) link.mesh_L = subdivide(coarsen(link.mesh_L, kCell_m), parts);
  return model;
}

}  // namespace berth::bench
