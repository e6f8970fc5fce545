#pragma once

#include <functional>
#include <vector>

#include "lab/trust/trial.hpp"

namespace berth::lab {

/// One link under one condition.
struct Sample {
  const Trial* trial;
  const sim::TrueDistance* truth;
  const Estimate* estimate;
  int link;

  bool is_covered() const { return truth->sight == sim::ObstacleSight::covered; }
  bool is_ok() const { return estimate->status == LinkStatus::ok; }
  /// Above 0: too large.
  double over_seen_m() const { return estimate->distance_m - truth->seen_C.distance_m; }
  double over_whole_m() const { return estimate->distance_m - truth->whole_m; }
  /// There is something within the range, and berth says that there is not.
  bool is_lost() const {
    return estimate->status == LinkStatus::none_in_range &&
           truth->seen_C.distance_m <= kTrialRange_m;
  }
  /// The excess above the metric's own, in pixels.
  double over_px() const;
};

/// All links of all trials.
std::vector<Sample> samples_of(const std::vector<Trial>& trials, std::size_t condition);

/// Those for which keep(sample) holds.
std::vector<Sample> filtered(const std::vector<Sample>& samples,
                             const std::function<bool(const Sample&)>& keep);

}  // namespace berth::lab
