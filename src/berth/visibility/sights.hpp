// Inside visibility/ only: what several cameras know of many points, many of them at a time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "berth/types/guarded_box.hpp"
#include "berth/visibility/sample_points.hpp"
#include "berth/visibility/seeing_camera.hpp"
#include "berth/visibility/sight_count.hpp"

namespace berth {

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
