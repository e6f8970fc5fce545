// Inside record/ only.
#pragma once

#include <optional>
#include <string>

#include "berth/record/replay.hpp"

namespace berth {

/// The first field in which two results differ, as JSON; none where they are equal to the last bit.
/// Throws std::exception where one is no JSON.
std::optional<ReplayDifference> first_difference(const std::string& recorded,
                                                 const std::string& replayed);

}  // namespace berth
