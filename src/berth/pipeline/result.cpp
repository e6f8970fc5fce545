#include "berth/pipeline/result.hpp"

#include <algorithm>

namespace berth {

RequestTiming timing_of(std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  // The least time that this share of them did not exceed.
  const auto percentile = [&](double share) {
    return times_us[static_cast<std::size_t>(
                        std::ceil(share * static_cast<double>(times_us.size()))) -
                    1];
  };
  return {static_cast<int>(times_us.size()), times_us.front(), percentile(0.5), percentile(0.99),
          times_us.back()};
}

void find_nearest(Result& result) {
  result.nearest = -1;
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    const LinkResult& link = result.links[i];
    if (!link.is_moved || !link.has_distance()) continue;
    const LinkResult* nearest = result.nearest_link();
    if (!nearest || link.distance_m < nearest->distance_m) result.nearest = static_cast<int>(i);
  }
}

const LinkResult* Result::nearest_to_all() const {
  const LinkResult* found = nullptr;
  for (const LinkResult& link : links) {
    const float distance_m = link.distance_to_all_m();
    if (!link.is_moved || std::isnan(distance_m)) continue;
    if (!found || distance_m < found->distance_to_all_m()) found = &link;
  }
  return found;
}

void withhold(Result& result) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  result.status = ResultStatus::stale;
  result.pose.X_BL.clear();
  result.nearest = -1;
  for (LinkResult& link : result.links) {
    static_cast<SpacePair&>(link) = {};
    static_cast<SpacePair&>(link.occupied) = {};
    link.known = {.gradient = std::move(link.known.gradient)};
    for (auto* gradient : link.gradients()) std::ranges::fill(*gradient, kNaN);
    link.candidates.clear();
    link.lower_bound_m = link.occupied.lower_bound_m = kNaN;
    link.status = LinkStatus::stale;
    link.assumed_thinner_m = kNaN;
    link.robot_point_C_m = link.obstacle_point_C_m = link.mean_direction_B = link.mean_direction_C =
        unset_point();
    link.mean_count = 0;
    link.visibility = {};
    link.visibility.id = link.id;
  }
}

}  // namespace berth
