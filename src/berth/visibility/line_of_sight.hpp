// Inside visibility/ only: what stands on the line of sight to a point, or to many at a time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/depth_units.hpp"
#include "berth/types/guarded_box.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {

/// One depth image after the self filter: the robot as it stood at the exposure, the obstacles,
/// each pixel's fate. All images have the camera's size.
struct SeenFrame {
  const Camera& camera;
  const RobotImage& robot;
  const ObstacleImage& obstacles;
  /// The self filter's own.
  Tolerance tolerance;
};

/// A point of a link's surface in frame C, with its unit normal of either side.
struct LinkPoint {
  LinkId id;
  Eigen::Vector3d p_C_m;
  Eigen::Vector3d normal_C;
};

/// What the frame knows of a point in space. It is seen where the reading lies behind it; in front
/// of the robot only where it is nearer than the robot by more than the tolerance, because nearer
/// readings to the robot were removed with it.
Sight sight_of_space(const SeenFrame& frame, const Eigen::Vector3d& p_C_m);

/// A point of a surface, and the pixel that shows it.
struct SurfaceSight {
  Sight sight;
  /// Whether the robot image shows the point: seen, but for what the sensor reports.
  bool is_drawn;
};

/// What the frame knows of a point of a link. `robot` is rendered at the pose that the link has: at
/// that of the exposure or at another one. The point is hidden by the robot where the nearest
/// pixel, or one of the four around it that shows the point's own link, shows something in front of
/// the point's tangent plane by more than a pixel's width; or where the robot of the exposure stood
/// in front of it by more than the tolerance. Where none of the four shows its link it has no
/// reading.
SurfaceSight sight_of_surface(const SeenFrame& frame, const RobotImage& robot,
                              const LinkPoint& point);

/// One camera's frame for find_whole_robot_visibility().
struct SeeingCamera {
  SeenFrame frame;
  /// The raw image, rounded down.
  const UnitImage& sensor_depth;
  Pose X_CB;
};

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
