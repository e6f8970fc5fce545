#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lab/bundled_scene/output_files.hpp"

namespace berth::lab {
namespace {

std::string camera_entry(const sim::BundledCamera& camera) {
  const Eigen::Vector3d& p = camera.place.xyz_T_m;
  const Eigen::Quaterniond& q = camera.place.rotation_TC;
  return fmt::format(R"(  - name: {}
    info: {}
    pose:
      parent: {}
      xyz: [{:.3f}, {:.3f}, {:.3f}]
      quaternion_xyzw: [{:.6f}, {:.6f}, {:.6f}, {:.6f}]
    depth: {}/*.png
    depth_scale: 0.001
    stamps: [{:.3f}]
)",
                     camera.name, camera.info_file, sim::kTableLink, p.x(), p.y(), p.z(), q.x(),
                     q.y(), q.z(), q.w(), camera.depth_folder, fmt::join(camera.stamps_s, ", "));
}

}  // namespace

std::string camera_info_yaml(const sim::BundledCamera& of) {
  const Camera& c = of.camera;
  return fmt::format(R"(image_width: {0}
image_height: {1}
camera_name: {6}
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
                     c.width_px, c.height_px, c.fx_px, c.cx_px, c.fy_px, c.cy_px, of.name);
}

std::string scene_yaml(std::span<const sim::BundledCamera> cameras, const std::string& evaluation) {
  std::string text = fmt::format(R"(# yaml-language-server: $schema=../schema/scene.json
# Made by lab/bundled_scene; README.md says what it shows.
robot:
  urdf: arm/arm.urdf
  package_paths: {{berth_arm: arm}}
  geometry: visual
  environment_links: [{}]
cameras:
)",
                                 sim::kTableLink);
  for (const sim::BundledCamera& camera : cameras) text += camera_entry(camera);
  return text + fmt::format("joints: joints.csv\nevaluation: {{{}}}\n", evaluation);
}

std::string joints_csv(const std::vector<sim::JointRow>& rows) {
  std::string text = "time";
  for (int j = 0; j < sim::kArmJoints; ++j) text += fmt::format(",{}", sim::arm_joint_name(j));
  text += "\n";
  for (const sim::JointRow& row : rows)
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
