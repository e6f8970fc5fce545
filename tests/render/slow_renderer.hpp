// The slow, obvious twin of RobotRenderer: each pixel's ray against every triangle, in doubles.
#pragma once

#include <array>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct RayHit {
  LinkId id = kNoLink;
  double depth_m = std::numeric_limits<double>::infinity();
};

class SlowRenderer {
 public:
  SlowRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
               const Camera& camera);

  /// What the ray through (u, v), in pixels, meets first.
  RayHit hit(double u, double v) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners_C_m;
    LinkId id;
  };
  Camera camera_;
  std::vector<Triangle> triangles_;
};

/// How an image differs from the twin's.
struct Comparison {
  int pixels = 0;
  int robot_pixels = 0;
  /// Differences within 0.02 px of an outline or a crease, where rounding decides.
  int at_edges = 0;
  /// All others: id, depth by more than 1e-4 of itself, or a depth where no link is.
  std::vector<Pixel> wrong;
};

Comparison compare(const RobotImage& image, const SlowRenderer& twin);

}  // namespace berth
