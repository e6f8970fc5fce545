// The ranges in which a real recording's distances lie.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace berth::lab {

/// The range that a link's distance lies in (expected.tsv).
struct ExpectedRange {
  double min_m = 0;
  double max_m = 0;
  /// Against a background without a robot; else an estimate.
  bool is_checked = false;
};

/// A distance above max_m by more than this is too far: a range is an estimate, too.
inline constexpr double kFarMargin_m = 0.01;

/// By frame and link.
using ExpectedRanges = std::map<std::pair<int, std::string>, ExpectedRange>;

/// Of a recording's expected.tsv. Throws std::runtime_error where it cannot be read.
ExpectedRanges read_expected_ranges(const std::filesystem::path& file);

}  // namespace berth::lab
