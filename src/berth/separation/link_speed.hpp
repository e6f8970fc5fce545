// How fast the fastest point of a link moves.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// Some of a mesh's vertices, in its own frame L. The whole mesh lies within slack_m of their
/// convex hull. No point of a rigid body is faster than the fastest corner of a hull around it, so
/// that these few stand for all.
struct HullPoints {
  std::vector<Eigen::Vector3f> points_L_m;
  float slack_m = 0;
};

/// Empty for a mesh without vertices.
HullPoints hull_points(const TriangleMesh& mesh_L, float slack_m = 0.005F);

/// No point of the mesh is faster than this, and one is nearly as fast: only slack_m times the
/// angular velocity may be between. The link stands at X_BL and moves by `twist`; m/s.
double greatest_speed_m_s(const HullPoints& hull, const Pose& X_BL, const LinkTwist& twist);

/// No point of the mesh is farther from where it was, and one nearly is, as above: from X_BL_before
/// to X_BL.
double greatest_displacement_m(const HullPoints& hull, const Pose& X_BL_before, const Pose& X_BL);

}  // namespace berth
