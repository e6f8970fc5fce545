// Inside visibility/ only: what several cameras know of many points, many of them at a time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "berth/types/guarded_box.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/visibility/line_of_sight.hpp"
#include "berth/visibility/sample_points.hpp"

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

/// Points p_i = origin + the sum of both parts' turn * points_i, in the root link's frame B.
struct PlacedPoints {
  struct Part {
    const PointLanes* points = nullptr;
    Eigen::Matrix3f turn = Eigen::Matrix3f::Zero();
  };

  /// At most kSamplePoints.
  int count = 0;
  Eigen::Vector3f origin_B_m = Eigen::Vector3f::Zero();
  std::array<Part, 2> parts;
};

/// Of points of the robot's surface: each is seen where its pixel's reading lies at the point, by
/// the self filter's tolerance, or behind it. A point counts by the view that knows most of it, in
/// the order of Sight.
SightCount count_surface_sights(std::span<const SeeingCamera> views, const PlacedPoints& points);

/// How many lie in no view's image, nor in a box.
int count_unobserved(std::span<const SeeingCamera> views, std::span<const GuardedBox> guarded,
                     const PlacedPoints& points);

/// Of points in space, each as sight_of_space() says.
SightCount count_space_sights(std::span<const SeeingCamera> views, const PlacedPoints& points);

}  // namespace berth
