#include "lab/trust/sample.hpp"

#include <algorithm>
#include <iterator>

namespace berth::lab {

double Sample::over_px() const {
  const double bound_m = sim::max_overestimate_m(trial->camera, *truth);
  const double pixels_m = sim::kMaxOverestimate_px * sim::pixel_size_m(trial->camera, *truth);
  const double metric_m = bound_m - pixels_m;
  return sim::kMaxOverestimate_px * (over_seen_m() - metric_m) / pixels_m;
}

std::vector<Sample> samples_of(const std::vector<Trial>& trials, std::size_t condition) {
  std::vector<Sample> samples;
  for (const Trial& trial : trials) {
    const std::vector<Estimate>& estimates = trial.estimates[condition];
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      samples.push_back({&trial, &trial.truth[i], &estimates[i], static_cast<int>(i)});
    }
  }
  return samples;
}

std::vector<Sample> filtered(const std::vector<Sample>& samples,
                             const std::function<bool(const Sample&)>& keep) {
  std::vector<Sample> kept;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(kept), keep);
  return kept;
}

}  // namespace berth::lab
