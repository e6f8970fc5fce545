// Inside visibility/ only.
#pragma once

#include <array>

#include "berth/types/link_visibility.hpp"

namespace berth {

/// How many points have each sight.
class SightCount {
 public:
  void add(Sight sight, int points = 1) {
    count_[static_cast<std::size_t>(sight)] += points;
    sum_ += points;
  }
  int sum() const { return sum_; }
  SightShares shares() const {
    if (sum_ == 0) return {};
    return {share(Sight::seen), share(Sight::hidden_by_obstacles), share(Sight::hidden_by_robot),
            share(Sight::no_reading), share(Sight::outside_image)};
  }
  /// Of what is neither seen nor part of an obstacle; NaN of nothing.
  float unknown_share() const {
    const int known = count(Sight::seen) + count(Sight::hidden_by_obstacles);
    return static_cast<float>(sum_ - known) / static_cast<float>(sum_);
  }

  int count(Sight sight) const { return count_[static_cast<std::size_t>(sight)]; }

 private:
  float share(Sight sight) const {
    return static_cast<float>(count(sight)) / static_cast<float>(sum_);
  }

  std::array<int, kSightCount> count_{};
  int sum_ = 0;
};

}  // namespace berth
