#pragma once

#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Answers whether a point in space is near the robot's visible surface (evaluated links, not
/// scenery).
class RobotNeighbourhood {
 public:
  /// Sorts the robot's pixels into tiles. `robot` has to outlive the questions. Reuses memory.
  void build(const Camera& camera, const RobotImage& robot);

  /// True where some robot pixel's centre, back-projected at its depth, lies within `radius_m`
  /// (Euclidean) of that of pixel (u, v) at `depth_m`.
  bool is_near(int u, int v, double depth_m, double radius_m) const;

  /// The pixels that may be near a point of the robot at all; empty without a robot.
  PixelRect reach(double radius_m) const;

 private:
  struct Tile {
    float nearest_m;
    float farthest_m;
  };
  bool any_pixel_near(int column, int row, const Eigen::Vector3d& p_C, double radius2_m2) const;

  Camera camera_;
  const RobotImage* robot_ = nullptr;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Tile> tiles_;
  PixelRect bounds_;
  float nearest_m_ = 0;
  float farthest_m_ = 0;
};

}  // namespace berth
