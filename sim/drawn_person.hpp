// People drawn before a robot, into images that a camera took without them.
#pragma once

#include <cstdint>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "sim/random.hpp"

namespace berth::sim {

/// Trunk, head, arms and legs of capsules in random postures, upright (the base's z), near
/// `place_B_m`.
TriangleMesh draw_person(Random& random, const Eigen::Vector3d& place_B_m);

/// The image with the person in it.
DepthImage with_person(const TriangleMesh& person_B, const Camera& camera, const Pose& X_BC,
                       const DepthImage& depth_m, const RobotImage& robot);

/// A camera's image of a robot with somebody before it who hides about so large a share of it, 90 %
/// at most, and with mixed pixels at their outline.
DepthImage hide_robot(double share, const Camera& camera, const Pose& X_BC,
                      const Eigen::Vector3d& robot_B_m, const DepthImage& depth_m,
                      const RobotImage& robot, std::uint32_t seed);

}  // namespace berth::sim
