#include "lab/trust/look.hpp"

#include <fmt/format.h>

#include <array>

#include "apps/berth/picture.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "lab/trust/scene_images.hpp"
#include "thesis/image_result.hpp"

namespace berth::lab {
namespace {

std::vector<Condition> looked_at() {
  SelfFilterSettings no_flying_patches;
  no_flying_patches.flying_patch_radius_m = 0;
  return {{"", "ideal filter", {}, {}, MeasuredFilter::ideal},
          {"", "default settings"},
          {"", "rejected", {}, {}, MeasuredFilter::berth, {}, MeasuredMetric::hirt, true},
          {"", "no flying patches", {}, {}, MeasuredFilter::berth, no_flying_patches}};
}

std::string text_of(const Eigen::Vector3d& p) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x(), p.y(), p.z());
}

void print_links(const Trial& trial, const std::vector<Condition>& conditions) {
  fmt::print("| link | sight | robot's point | obstacle's point | true |");
  for (const Condition& condition : conditions) fmt::print(" {} |", condition.name);
  fmt::print("\n| --- | --- | --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
  constexpr std::array kSights = {"covered", "behind the robot", "outside"};
  for (std::size_t i = 0; i < trial.truth.size(); ++i) {
    const sim::TrueDistance& truth = trial.truth[i];
    fmt::print("| {} | {} | {} | {} | {:.1f} |", trial.robot->model.evaluated_link_names()[i],
               kSights[static_cast<std::size_t>(truth.sight)], text_of(truth.seen_C.a_m),
               text_of(truth.seen_C.b_m), 1e3 * truth.seen_C.distance_m);
    for (const auto& estimates : trial.estimates) {
      fmt::print(" {:.1f} |", 1e3 * estimates[i].distance_m);
    }
    fmt::print("\n");
  }
}

void draw(const TrialRobot& robot, const sim::DrawnScene& scene, std::uint32_t seed,
          const std::filesystem::path& picture) {
  SceneImages images(robot.model, robot.meshes, scene, seed);
  const RobotImage& image = images.believed({});
  SelfFilterWorkspace workspace;
  ObstacleImage obstacles;
  self_filter(scene.camera, scene.depth_m, image, {}, workspace, obstacles);
  ImageResult result = empty_image_result(Robot(robot.model), Method::exact, {});
  tell_image_distances(
      exact_distances(scene.camera, image, robot.model.link_count(), obstacles.depth_m), scene.X_BC,
      result);
  std::vector<app::PictureLink> links;
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    links.push_back({result.links[i], result.pairs_of[i].robot_pixel});
  }
  app::write_picture(picture, {scene.depth_m, &image, &obstacles, &links, kTrialRange_m,
                               fmt::format("{}, seed {}", robot.name, seed)});
}

}  // namespace

void look_at_scene(const TrialRobot& robot, const sim::DrawnSceneSettings& settings,
                   std::uint32_t seed, const std::filesystem::path& picture) {
  const std::vector<Condition> conditions = looked_at();
  print_links(run_trial(robot, settings, seed, conditions), conditions);
  draw(robot, sim::draw_scene(robot.model, robot.link_trees, settings, seed), seed, picture);
}

}  // namespace berth::lab
