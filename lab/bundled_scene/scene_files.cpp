#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lab/bundled_scene/output_files.hpp"

namespace berth::lab {

std::string camera_info_yaml(const Camera& c) {
  return fmt::format(R"(image_width: {0}
image_height: {1}
camera_name: camera
camera_matrix:
  rows: 3
  cols: 3
  data: [{2:.1f}, 0.0, {3:.1f}, 0.0, {4:.1f}, {5:.1f}, 0.0, 0.0, 1.0]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0.0, 0.0, 0.0, 0.0, 0.0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
projection_matrix:
  rows: 3
  cols: 4
  data: [{2:.1f}, 0.0, {3:.1f}, 0.0, 0.0, {4:.1f}, {5:.1f}, 0.0, 0.0, 0.0, 1.0, 0.0]
)",
                     c.width_px, c.height_px, c.fx_px, c.cx_px, c.fy_px, c.cy_px);
}

std::string scene_yaml(const CameraPlace& place, const std::vector<double>& stamps_s) {
  const Eigen::Vector3d& p = place.xyz_T_m;
  const Eigen::Quaterniond& q = place.rotation_TC;
  return fmt::format(R"(# Made by lab/bundled_scene; README.md says what it shows.
robot:
  urdf: arm/arm.urdf
  package_paths: {{berth_arm: arm}}
  geometry: visual
  environment_links: [{}]
cameras:
  - name: camera
    info: camera_info.yaml
    pose:
      parent: {}
      xyz: [{:.3f}, {:.3f}, {:.3f}]
      quaternion_xyzw: [{:.6f}, {:.6f}, {:.6f}, {:.6f}]
    depth: depth/*.png
    depth_scale: 0.001
    stamps: [{:.3f}]
joints: joints.csv
evaluation: {{method: exact, range_m: 1.0}}
)",
                     kTableLink, kTableLink, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w(),
                     fmt::join(stamps_s, ", "));
}

std::string joints_csv(const std::vector<JointRow>& rows) {
  std::string text = "time";
  for (int j = 0; j < kArmJoints; ++j) text += fmt::format(",{}", arm_joint_name(j));
  text += "\n";
  for (const JointRow& row : rows)
    text += fmt::format("{:.2f},{:.6f}\n", row.time_s, fmt::join(row.angle_rad, ","));
  return text;
}

std::string truth_csv(const std::vector<TruthRow>& rows) {
  std::string text = "frame,link,whole_m,seen_m\n";
  for (const TruthRow& row : rows)
    text += fmt::format("{},{},{:.6f},{}\n", row.frame, row.link, row.whole_m,
                        std::isnan(row.seen_m) ? "" : fmt::format("{:.6f}", row.seen_m));
  return text;
}

}  // namespace berth::lab
