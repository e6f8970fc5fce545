// Scenes in which the robot is where it should be, or nearly.
#pragma once

#include <cstdint>

#include "berth/scene/open_scene.hpp"

namespace berth::lab {

/// The camera believed to be off by so much, in a random direction and about a random axis.
void move_camera(OpenScene& scene, std::size_t camera, double offset_m, double angle_rad,
                 std::uint32_t seed);

/// The camera with one image alone, its `seed`-th one, and in it somebody who hides up to 90 % of
/// the robot.
void hide_robot(OpenScene& scene, std::size_t camera, std::uint32_t seed);

/// The robot in five poses in a drawn room, before a camera that stands where it should. Every
/// other sensor is ideal, the rest have a Kinect's errors. Throws std::runtime_error where the
/// robot cannot be seen.
OpenScene draw_good_scene(const RobotModel& model, std::uint32_t seed);

}  // namespace berth::lab
