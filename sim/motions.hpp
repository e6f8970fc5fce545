// A folder of motion capture, without what nobody did.
#pragma once

#include <filesystem>
#include <vector>

#include "sim/bvh.hpp"

namespace berth::sim {

/// No joint of a person is faster: where one is, its markers were lost.
inline constexpr double kFastestJoint_m_s = 8;

/// The longest piece of a motion in which no joint is faster than kFastestJoint_m_s, and without
/// its first quarter of a second, in which CMU's conversions lead over from a T-pose. Empty where
/// less than a second is left.
Bvh as_measured(Bvh motion);

/// as_measured() of each *.bvh in the folder and below, by their paths. Throws std::runtime_error
/// with the folder or file, what is there and what was expected: as read_bvh(), and where the
/// folder is missing or has none, or a file has nothing left.
std::vector<Bvh> read_motions(const std::filesystem::path& folder);

}  // namespace berth::sim
