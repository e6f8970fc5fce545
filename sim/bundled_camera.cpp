#include "sim/bundled_camera.hpp"

#include <cmath>

#include "sim/motion.hpp"

namespace berth::sim {
namespace {

// Without roll: the image's x is level.
BundledPlace look_at(const Eigen::Vector3d& eye_T_m, const Eigen::Vector3d& target_T_m) {
  const Eigen::Vector3d z = (target_T_m - eye_T_m).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  Eigen::Quaterniond q(axes);
  for (double& c : q.coeffs()) c = std::round(c * 1e6) / 1e6;
  return {eye_T_m, q};
}

Camera make_camera(int width_px, int height_px, double focal_px) {
  return {width_px, height_px, focal_px, focal_px, (width_px - 1) / 2., (height_px - 1) / 2.};
}

}  // namespace

Pose BundledPlace::X_TC() const {
  return Eigen::Translation3d(xyz_T_m) * Pose(rotation_TC.normalized());
}

std::vector<BundledCamera> bundled_cameras() {
  return {{"camera", make_camera(640, 480, 525), look_at({0.12, -2.25, 0.80}, {0.56, 0.10, 0.17}),
           exposures_s(0.013, 10, 36), 20150731, "camera_info.yaml", "depth"},
          {"left", make_camera(424, 240, 250), look_at({-0.90, 0.45, 1.60}, {0.55, -0.05, 0.28}),
           exposures_s(0.033, 10, 36), 20150801, "camera_info_left.yaml", "depth_left"},
          {"right", make_camera(480, 360, 400), look_at({0.95, 1.40, 1.55}, {0.55, -0.05, 0.22}),
           exposures_s(0.047, 8, 29), 20150802, "camera_info_right.yaml", "depth_right"}};
}

}  // namespace berth::sim
