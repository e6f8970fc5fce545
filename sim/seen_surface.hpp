#pragma once

#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"
#include "sim/embree_renderer.hpp"

namespace berth::sim {

/// The part of each link that the camera sees: [i] in frame C is that of the link with the id
/// i + 1, whether an obstacle stands before it or not. For each pixel that shows the link in
/// `robot`, the triangles that four rays of `rays` (which sees the same robot) through the pixel
/// meet there, cut off at the pixel's borders. Between the rays, less than half a pixel may be
/// missing.
std::vector<TriangleMesh> seen_surfaces_C(const RobotModel& model, const RobotPose& pose,
                                          const Pose& X_BC, const Camera& camera,
                                          const EmbreeRenderer& rays, const RobotImage& robot);

}  // namespace berth::sim
