#include <fmt/format.h>

#include <algorithm>

#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "lab/trust/real_image.hpp"

namespace berth::lab {
namespace {

/// The background is the image without the robot.
Background learned(const RealImage& image, const SensorSettings& settings) {
  Background background;
  if (settings.background_frames == 0) return background;
  RobotImage no_robot;
  no_robot.depth_m.resize(image.camera.width_px, image.camera.height_px, kNoDepth);
  no_robot.link_id.resize(image.camera.width_px, image.camera.height_px, kNoLink);
  no_robot.extent = {};
  SelfFilterWorkspace workspace;
  ObstacleImage all;
  self_filter(image.camera, image.depth_m, no_robot, {}, workspace, all);
  background.learn(image.camera, image.depth_m, no_robot, all.fate, settings);
  return background;
}

struct Row {
  /// Of links that are farther than with the ideal filter by more than rounding.
  std::vector<double> farther_m;
  int links = 0;
  int lost = 0;

  void add(const LinkDistance& ideal, const Estimate& estimate) {
    constexpr double kRounding_m = 1e-5;
    if (ideal.status != LinkStatus::ok) return;
    ++links;
    lost += estimate.status != LinkStatus::ok;
    const double farther = estimate.distance_m - ideal.distance_m;
    if (farther > kRounding_m) farther_m.push_back(farther);
  }
  std::string text(const char* name) {
    std::sort(farther_m.begin(), farther_m.end());
    const auto at = [&](double share) {
      if (farther_m.empty()) return 0.0;
      return 1e3 *
             farther_m[static_cast<std::size_t>(share * static_cast<double>(farther_m.size() - 1))];
    };
    return fmt::format("| {} | {} | {:.1f} % | {:.1f} | {:.1f} | {:.1f} | {} |\n", name, links,
                       100.0 * static_cast<double>(farther_m.size()) / std::max(links, 1), at(0.5),
                       at(0.99), at(1), lost);
  }
};

}  // namespace

std::vector<RealImageRules> all_real_image_rules() {
  SelfFilterSettings no_flying_patches, no_padding, narrow;
  no_flying_patches.flying_patch_radius_m = 0;
  no_padding.padding_m = 0;
  narrow.tolerance_m = 0.02;
  narrow.padding_m = 0.01;
  narrow.flying_patch_radius_m = 0;
  SensorSettings small_blobs, large_blobs, background;
  small_blobs.speckle_px = 20;
  large_blobs.speckle_px = 60;
  background.background_frames = 1;
  return {
      {"default self filter"},
      {"default, rejected distances counted", {}, {}, true},
      {"no flying patches", no_flying_patches},
      {"2 cm, 1 cm", narrow},
      {"no padding", no_padding},
      {"no padding, rejected distances counted", no_padding, {}, true},
      {"no padding, `speckle_px: 20`", no_padding, small_blobs},
      {"no padding, `speckle_px: 60`", no_padding, large_blobs},
      {"no padding, `speckle_px: 60`, rejected distances counted", no_padding, large_blobs, true},
      {"default, `background_frames: 1`", {}, background}};
}

std::vector<Estimate> estimate(const RealScene& scene, const RealImageRules& rules) {
  const Camera& camera = scene.image->camera;
  SelfFilterWorkspace workspace;
  SensorWorkspace sensor;
  ObstacleImage obstacles;
  self_filter(camera, scene.depth_m, scene.robot_image, rules.self_filter, workspace, obstacles);
  const Background background = learned(*scene.image, rules.sensor);
  apply_sensor_rules(camera, scene.depth_m, scene.robot_image, {.background = &background},
                     rules.sensor, sensor, obstacles);
  const LinkDistances distances = exact_distances(
      camera, scene.robot_image, scene.robot->model.link_count(), obstacles.depth_m);
  return rules.counts_rejected
             ? with_rejected(camera, scene.robot_image, scene.depth_m, obstacles, distances)
             : to_estimates(distances);
}

std::string real_image_table(const std::vector<RealImage>& images,
                             const std::vector<TrialRobot>& robots, int scenes) {
  const std::vector<RealImageRules> rules = all_real_image_rules();
  std::vector<Row> rows(rules.size());
  int drawn = 0;
  for (int i = 0; i < scenes; ++i) {
    const RealImage& image = images[i % images.size()];
    const TrialRobot& robot = robots[i / images.size() % robots.size()];
    const auto scene = draw_into(image, robot, static_cast<std::uint32_t>(i));
    if (!scene) continue;
    ++drawn;
    for (std::size_t r = 0; r < rules.size(); ++r) {
      const std::vector<Estimate> estimates = estimate(*scene, rules[r]);
      for (std::size_t link = 0; link < estimates.size(); ++link) {
        rows[r].add(scene->ideal.links[link], estimates[link]);
      }
    }
  }
  std::string text = fmt::format(
      "\n## Real depth images: {} of {} scenes\n"
      "| | links | farther | median | 99 % | greatest | lost |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
      drawn, scenes);
  for (std::size_t r = 0; r < rules.size(); ++r) text += rows[r].text(rules[r].name.c_str());
  return text;
}

}  // namespace berth::lab
