#include "lab/calibration/judge.hpp"

#include <fmt/format.h>

#include <cmath>

#include "berth/files/png.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/scene_calibration.hpp"
#include "lab/filter/expected_ranges.hpp"
#include "lab/measure/stopwatch.hpp"
#include "thesis/image_query.hpp"

namespace berth::lab {
namespace {

constexpr int kNear_px = 10;
constexpr float kLikeRobot_m = 0.10F;

/// Whether the reading lies at the robot's own depth: else it shows what is behind the robot, and
/// the colour image's mask and the depth image do not agree to the pixel.
bool is_like_robot(const RobotImage& robot, int u, int v, float z_m) {
  const PixelRect near = clip({u - kNear_px, v - kNear_px, u + kNear_px + 1, v + kNear_px + 1},
                              robot.depth_m.width(), robot.depth_m.height());
  for (int b = near.v_begin; b < near.v_end; ++b) {
    for (int a = near.u_begin; a < near.u_end; ++a) {
      if (std::abs(robot.depth_m(a, b) - z_m) < kLikeRobot_m) return true;
    }
  }
  return false;
}

/// None where there is none of the depth image's size: colour and depth have grids of their own
/// then.
std::optional<Image<LinkId>> read_mask(const std::filesystem::path& folder, std::size_t image,
                                       const Camera& camera) {
  for (const std::string& name :
       {fmt::format("robot_mask_{:06}.png", image), fmt::format("robot_mask_{}.png", image)}) {
    const std::filesystem::path file = folder / "reference" / name;
    if (!std::filesystem::exists(file)) continue;
    try {
      return read_link_ids_png(file, camera);
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

void count_mask(const Image<LinkId>& mask, const Frame& frame, DepthView depth_m,
                Judgement& judgement) {
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      if (mask(u, v) == 0) continue;
      ++judgement.mask_pixels;
      if (!is_kept(frame.obstacles.fate(u, v))) continue;
      ++judgement.mask_pixels_left;
      judgement.robot_pixels_left += is_like_robot(frame.robot, u, v, depth_m(u, v));
    }
  }
}

}  // namespace

Calibrated calibration_data(const SceneFile& file) {
  const OpenScene scene = open_scene(file);
  const SceneCalibrationData material = make_calibration_data(scene);
  Calibrated calibrated;
  const Stopwatch stopwatch;
  calibrated.found = calibrate(material.calibration_data);
  calibrated.time_s = stopwatch.ms() / 1000;
  const CameraSettings& settings = scene.cameras[0].mounted->settings();
  calibrated.proposal = propose_filter(material.calibration_data, 0, calibrated.found, false,
                                       settings.self_filter, settings.sensor);
  return calibrated;
}

double apart_m(const Pose& X_PC, const Pose& X_PC_other, double depth_m) {
  double sum_m = 0;
  int count = 0;
  const Pose X_CC = X_PC_other.inverse() * X_PC;
  for (const double x : {-0.3, 0.0, 0.3}) {
    for (const double y : {-0.3, 0.0, 0.3}) {
      const Eigen::Vector3d p_C_m(x, y, depth_m);
      sum_m += (X_CC * p_C_m - p_C_m).norm();
      ++count;
    }
  }
  return sum_m / count;
}

SceneFile with_result(SceneFile scene, const CalibrationResult& found,
                      std::span<const FilterProposal> filters) {
  for (std::size_t c = 0; c < filters.size(); ++c) {
    SceneCamera& camera = scene.cameras[c];
    camera.X_PC = found.cameras[c].X_PC;
    camera.clock_offset_s = found.cameras[c].clock_offset_s;
    camera.settings.self_filter = filters[c].self_filter_settings;
    camera.settings.sensor = filters[c].sensor_settings;
  }
  for (const auto& [joint, offset] : found.joint_offsets) scene.joint_offsets[joint] += offset;
  return scene;
}

SceneFile with_result(SceneFile scene, const Calibrated& calibrated) {
  return with_result(std::move(scene), calibrated.found, {&calibrated.proposal, 1});
}

Judgement judge(const SceneFile& file, const std::filesystem::path& folder) {
  const OpenScene scene = open_scene(file);
  const OpenCamera& camera = scene.cameras.front();
  ExpectedRanges ranges;
  if (const auto tsv = folder / "expected.tsv"; std::filesystem::exists(tsv)) {
    ranges = read_expected_ranges(tsv);
  }
  const std::vector<std::string> names = scene.robot->model().evaluated_link_names();
  Observer observer(camera.mounted);
  ImageQuery query(scene.robot, Method::exact);
  Frame frame;
  Judgement judgement;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    const DepthImage depth_m = camera.read_depth(i);
    observer.observe(depth_m, camera.at_exposure[i], frame);
    for (const LinkResult& link : query.ask(frame).links) {
      if (ranges.empty()) continue;
      const ExpectedRange& range = ranges.at({static_cast<int>(i), names[link.id - 1]});
      const bool is_inside = link.distance_m >= range.min_m && link.distance_m <= range.max_m;
      (range.is_checked ? judgement.checked : judgement.estimates) += 1;
      (range.is_checked ? judgement.checked_in_range : judgement.estimates_in_range) += is_inside;
      judgement.too_far += !(link.distance_m <= range.max_m + kFarMargin_m);
    }
    if (const auto mask = read_mask(folder, i, camera.mounted->camera())) {
      count_mask(*mask, frame, depth_m, judgement);
    }
  }
  return judgement;
}

std::string text_of(const Judgement& judgement) {
  return fmt::format(
      "{} of {} checked rows in range, {} of {} estimates, {} too far; of {} mask "
      "pixels {} left, {} of them at the robot's depth",
      judgement.checked_in_range, judgement.checked, judgement.estimates_in_range,
      judgement.estimates, judgement.too_far, judgement.mask_pixels, judgement.mask_pixels_left,
      judgement.robot_pixels_left);
}

}  // namespace berth::lab
