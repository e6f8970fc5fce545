#pragma once

#include <string>

#include "berth/scene/frame_result.hpp"

namespace berth {

/// The frame's links as a table for people: a heading and one line for each link, columns aligned.
/// A link whose status is not ok has "-" for distance and pixels. With bounds, a distance that is
/// not known for sure stands as "bound to distance", and a bound alone as "bound or more". With
/// visibility, the last column is the share of the link's surface that is seen.
std::string result_table(const FrameResult& result);

}  // namespace berth
