// The slow, obvious twin of RobotRenderer: each pixel's ray against every triangle, in doubles.
#pragma once

#include <array>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "sim/ray_hit.hpp"

namespace berth {

class SlowRenderer {
 public:
  SlowRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
               const Camera& camera);

  /// What the ray through (u, v), in pixels, meets first.
  sim::RayHit hit(double u, double v) const { return hit_beyond(u, v, 0); }
  /// What it meets first of what is deeper than this.
  sim::RayHit hit_beyond(double u, double v, double least_m) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners_C_m;
    LinkId id;
  };
  Camera camera_;
  std::vector<Triangle> triangles_;
};

}  // namespace berth
