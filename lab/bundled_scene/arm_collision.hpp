#pragma once

#include <vector>

#include "sim/shapes.hpp"

namespace berth::lab {

/// A cylinder along the z of X_LS, or a sphere (length 0) at its origin. Lengths in metres.
struct CollisionShape {
  Pose X_LS;
  double radius_m;
  double length_m;
};

/// The collision geometry of a link: a few simple shapes around its visual mesh.
std::vector<CollisionShape> arm_collision(int link);

}  // namespace berth::lab
