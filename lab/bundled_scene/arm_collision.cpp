#include "lab/bundled_scene/arm_collision.hpp"

#include <numbers>

#include "sim/arm_shells.hpp"

namespace berth::lab {
namespace {

using std::numbers::pi;
const Pose kAlongY = sim::rotation(pi / 2, Eigen::Vector3d::UnitX());

// E is the frame of make_elbow.
std::vector<CollisionShape> elbow(const Pose& X_LE, double height_m) {
  return {{X_LE * sim::translation(0, 0, 0.05), 0.068, 0.10},
          {X_LE * sim::translation(0, -0.064, height_m) * kAlongY, 0.068, 0.135},
          {X_LE * sim::translation(0, -0.045, height_m - 0.08), 0.087, 0}};
}

}  // namespace

std::vector<CollisionShape> arm_collision(int link) {
  const Pose turned = sim::rotation(pi, Eigen::Vector3d::UnitZ());
  switch (link) {
    case 0:
      return {{sim::translation(0, 0, 0.055), 0.107, 0.11}};
    case 1:
      return elbow(Pose::Identity(), 0.200);
    case 2:
      return elbow(sim::upside_down(0.200), 0.200);
    case 3:
      return elbow(turned, 0.200);
    case 4:
      return elbow(turned * sim::upside_down(0.200), 0.200);
    case 5:
      return elbow(Pose::Identity(), 0.190);
    case 6:
      return {{sim::translation(0, 0.037, 0) * kAlongY, 0.052, 0.074},
              {sim::translation(0, 0, 0.027), 0.042, 0.054}};
    default:
      return {{sim::translation(0, 0, 0.018), 0.042, 0.086},
              {sim::translation(0, 0, 0.0885), 0.056, 0.105}};
  }
}

}  // namespace berth::lab
