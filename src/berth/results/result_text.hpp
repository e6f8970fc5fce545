#pragma once

#include <string>

#include "berth/pipeline/result.hpp"

namespace berth {

/// The frame's links as a table for people: a heading and one line for each link, columns aligned.
/// A link whose status is not ok has "-" for distance and pixels. With bounds, a distance that is
/// not known for sure stands as "bound to distance", and a bound alone as "bound or more". With
/// visibility, the last column is the share of the link's surface that is seen.
std::string result_table(const Result& result);

/// The result's status and what it comes from, such as "ok", "degraded: camera left is too_old
/// (0.42 s)" or "stale: the joints are 0.310 s old".
std::string status_text(const Result& result);

/// The trouble of one camera, such as "camera left is too_old (0.42 s)"; empty where nothing
/// is.
std::string camera_text(const CameraResult& camera);

/// What a monitor says, for people: its state, the scale of the speed, and why it is not larger.
/// Such as "reduced to 42 %: arm_link_5 is 0.310 m from what a camera sees; at 0.61 m/s it needs
/// 0.523 m". The result must have a separation.
std::string separation_text(const Result& result);

}  // namespace berth
