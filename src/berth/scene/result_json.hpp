#pragma once

#include <string>

#include "berth/scene/frame_result.hpp"

namespace berth {

/// The frame as one line of JSON, schema berth/result/2, without a line break at its end. Lengths
/// in metres. A link whose status is not ok has null for distance, points, pixels and mean
/// direction; the mean direction is null where its count is 0, too. Shares of visibility that are
/// not known are null. Every float can be read back
/// exactly and has few digits (0.1234; now and then more, where the JSON library prints those of a
/// double near it).
std::string result_json(const FrameResult& result);

}  // namespace berth
