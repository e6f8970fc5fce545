#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// A point of a surface and its normal, of either side, in the link's frame L.
struct SurfacePoint {
  Eigen::Vector3d p_L_m;
  Eigen::Vector3d normal_L;
};

/// `count` points, each of which stands for the same area: one in each of `count` equal parts of
/// the triangles' area, in their order. The same for the same mesh. None where no triangle has an
/// area.
std::vector<SurfacePoint> sample_surface(const TriangleMesh& mesh_L, int count);

/// `count` points, evenly spread over the ball of radius 1 around the origin.
std::vector<Eigen::Vector3d> sample_unit_ball(int count);

/// How many points stand for a link's surface, and for a ball. Of n points that were drawn by
/// chance a share has a standard error of at most 1 / (2 sqrt(n)): 0.025. These lie more evenly.
inline constexpr int kSamplePoints = 400;

/// The same points coordinate by coordinate, which stand side by side in vectors.
struct PointLanes {
  /// The most floats that a vector has.
  static constexpr int kMostLanes = 16;

  int count = 0;
  /// As long as kSamplePoints and `count` need in whole vectors: the points begin anew at the end.
  std::array<std::vector<float>, 3> at_m;
};

/// What the images are asked about: made once for a robot, then constant.
struct SamplePoints {
  /// surface[i] belongs to the link with the id i + 1.
  std::vector<std::vector<SurfacePoint>> surface;
  std::vector<Eigen::Vector3d> unit_ball;
  std::vector<PointLanes> surface_lanes;
  PointLanes unit_ball_lanes;
};

/// kSamplePoints for each evaluated link, and as many for a ball.
SamplePoints sample_points(const RobotModel& model);

}  // namespace berth
