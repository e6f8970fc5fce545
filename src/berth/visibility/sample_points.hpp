#pragma once

#include <Eigen/Core>
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

/// What find_visibility() asks the images about: made once for a robot, then constant.
struct SamplePoints {
  /// surface[i] belongs to the link with the id i + 1.
  std::vector<std::vector<SurfacePoint>> surface;
  std::vector<Eigen::Vector3d> unit_ball;
};

/// kSamplePoints for each evaluated link, and as many for a ball.
SamplePoints sample_points(const RobotModel& model);

}  // namespace berth
