// Inside record/ only: a depth image as ROS 2 has it on the wire, sensor_msgs/Image, so that
// others' programs show it.
#pragma once

#include <string>
#include <string_view>

#include "berth/types/image.hpp"

namespace berth {

inline constexpr std::string_view kImageType = "sensor_msgs/msg/Image";
/// The type's definition, with those that it names.
std::string_view image_definition();

/// Little endian CDR; every bit of a reading is kept. The encoding is 16UC1 where all readings are
/// whole millimetres, as most cameras give them: half of what 32FC1 takes, and that in a third of
/// the time.
std::string depth_message(DepthView depth_m, double stamp_s, std::string_view frame_id);

/// The image of what depth_message() wrote. Throws std::runtime_error that says what is wrong.
DepthImage depth_of_message(std::string_view bytes);

}  // namespace berth
