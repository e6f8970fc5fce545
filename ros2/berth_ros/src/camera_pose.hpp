#pragma once

#include <tf2_ros/buffer.h>
#include <optional>
#include <string>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth_ros {

/// Where TF says that a camera is fixed: to the first link of the robot above its frame in TF's
/// tree (the hand, for a camera there), else to the root, wherever both hang. None where TF does
/// not connect them; `why` then says it.
std::optional<berth::CameraMount> mount_from_tf(const tf2_ros::Buffer& tf,
                                                const berth::RobotModel& model,
                                                const std::string& optical_frame,
                                                const rclcpp::Time& stamp, std::string& why);

/// Whether both stand at the same place, to a tenth of a millimetre and 0.0001 rad.
bool is_same_mount(const berth::CameraMount& a, const berth::CameraMount& b);

}  // namespace berth_ros
