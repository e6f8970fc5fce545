// Something new beside the arm, at places nobody chose: no rule that is not there to drop pixels
// hides any of it, whatever the background says.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "berth/sensor/sensor_rules.hpp"
#include "tests/self_filter/random_scene.hpp"
#include "tests/sensor/images.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/thinned.hpp"
#include "thesis/evaluate.hpp"

namespace berth {
namespace {

/// A box, a rod or a finger that faces the camera, near a random pixel and the robot's depth there.
void add_new_thing(sim::Random& random, const RandomScene& scene, DepthImage& depth_m) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  const int u0 = random.whole(0, width - 1);
  const int v0 = random.whole(0, height - 1);
  const float robot_m = scene.robot.depth_m(u0, v0);
  const double about_m = std::isnan(robot_m) ? random(0.5, 2.5) : robot_m;
  const auto z = static_cast<float>(about_m + random(-0.2, 0.2));
  const int shape = random.whole(0, 2);
  const int thing_width = shape == 0 ? random.whole(5, 30) : random.whole(1, 5);
  const int thing_height = shape == 1 ? height : random.whole(5, 30);
  for (int v = v0; v < std::min(height, v0 + thing_height); ++v) {
    for (int u = u0; u < std::min(width, u0 + thing_width); ++u) {
      if (!(depth_m(u, v) < z)) depth_m(u, v) = z;
    }
  }
}

/// All rules but speckle, as strong as they get.
SensorSettings random_rules(sim::Random& random) {
  SensorSettings settings;
  settings.noise_m = random(0, 0.1);
  settings.background_frames = random.whole(0, 2);
  settings.background_clearance_m = random(0, 0.2);
  return settings;
}

class NewObstacle {
 public:
  explicit NewObstacle(std::uint32_t seed)
      : random_(seed),
        scene_(random_scene(seed)),
        settings_(random_rules(random_)),
        always_reads_(random_.chance(0.5)) {
    // Learned from images with all of the robot and its flying pixels in them, which no filter took
    // out.
    const RobotImage no_robot{
        DepthImage(scene_.camera.width_px, scene_.camera.height_px, kNoDepth),
        Image<LinkId>(scene_.camera.width_px, scene_.camera.height_px, kNoLink)};
    const ObstacleImage all = kept_image(scene_.sensor_depth_m);
    for (int i = 0; i < settings_.background_frames; ++i)
      background_.learn(scene_.camera, scene_.sensor_depth_m, no_robot, all.fate, settings_);
    DepthImage earlier = scene_.sensor_depth_m;
    for (float& z : earlier.pixels()) z += static_cast<float>(random_(-0.05, 0.05));
    observe(earlier);
    add_new_thing(random_, scene_, scene_.sensor_depth_m);
    observe(scene_.sensor_depth_m);
  }

  void expect_nothing_hidden() const {
    std::array<std::int64_t, kPixelFateCount> count{};
    for (std::size_t i = 0; i < before_.fate.pixels().size(); ++i) {
      const PixelFate fate = after_.fate.pixels()[i];
      const float z = after_.depth_m.pixels()[i];
      ++count[static_cast<std::size_t>(fate)];
      ASSERT_TRUE(fate == PixelFate::hole || is_kept(fate) == !std::isnan(z)) << i;
      if (!is_kept(before_.fate.pixels()[i])) continue;
      ASSERT_TRUE(is_kept(fate)) << i;
      ASSERT_LE(z, before_.depth_m.pixels()[i]) << i;
    }
    EXPECT_EQ(after_.count, count);
  }

  void expect_no_distance_larger() const {
    const std::vector<LinkDistance> before = distances(before_);
    const std::vector<LinkDistance> after = distances(after_);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].status != LinkStatus::ok) continue;
      ASSERT_EQ(after[i].status, LinkStatus::ok);
      EXPECT_LE(after[i].distance_m, before[i].distance_m);
    }
  }

  bool has(PixelFate fate) const { return after_.count_of(fate) > 0; }

 private:
  void observe(const DepthImage& depth_m) {
    self_filter(scene_.camera, depth_m, scene_.robot, scene_.settings, workspace_, before_);
    after_ = before_;
    apply_sensor_rules(scene_.camera, depth_m, scene_.robot,
                       {.background = &background_, .always_reads = always_reads_}, settings_,
                       sensor_, after_);
  }

  std::vector<LinkDistance> distances(const ObstacleImage& image) const {
    constexpr int kMostLinks = 5;
    SearchableDepth searchable;
    searchable.build(image.depth_m);
    ImageDistanceSettings settings;
    settings.mean_direction = false;
    EvaluateWorkspace workspace;
    LinkDistances out;
    evaluate(Method::exact, {scene_.camera, scene_.robot, kMostLinks, searchable, settings},
             workspace, out);
    return out.links;
  }

  sim::Random random_;
  RandomScene scene_;
  SensorSettings settings_;
  bool always_reads_;
  Background background_;
  SelfFilterWorkspace workspace_;
  SensorWorkspace sensor_;
  ObstacleImage before_;
  ObstacleImage after_;
};

TEST(NewObstacle, IsNeverHiddenAtThousandsOfPlaces) {
  std::array<int, kPixelFateCount> scenes{};
  for (std::uint32_t seed = 0; seed < thinned(2000U); ++seed) {
    SCOPED_TRACE(seed);
    const NewObstacle thing(seed);
    thing.expect_nothing_hidden();
    thing.expect_no_distance_larger();
    if (::testing::Test::HasFailure()) return;
    for (int fate = 0; fate < kPixelFateCount; ++fate)
      scenes[fate] += thing.has(static_cast<PixelFate>(fate));
  }
  EXPECT_GT(scenes[static_cast<int>(PixelFate::background)], thinned(300));
  EXPECT_GT(scenes[static_cast<int>(PixelFate::hole)], thinned(300));
}

TEST(SensorRules, ChangeNothingWhereAllAreOff) {
  RandomScene scene = random_scene(7);
  SelfFilterWorkspace workspace;
  ObstacleImage filtered;
  self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace, filtered);
  ObstacleImage image = filtered;
  SensorWorkspace sensor;
  apply_sensor_rules(scene.camera, scene.sensor_depth_m, scene.robot, {}, {}, sensor, image);
  EXPECT_TRUE(same_bits(image.depth_m, filtered.depth_m));
  EXPECT_EQ(image.fate.pixels(), filtered.fate.pixels());
  EXPECT_EQ(image.count, filtered.count);
}

TEST(SensorRules, DoNotDependOnTheNumberOfThreads) {
  SensorSettings settings;
  settings.speckle_px = 6;
  settings.background_frames = 1;
  const auto run = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const RandomScene scene = random_scene(11);
    SelfFilterWorkspace workspace;
    SensorWorkspace sensor;
    Background background;
    ObstacleImage image;
    for (int frame = 0; frame < 3; ++frame) {
      self_filter(scene.camera, scene.sensor_depth_m, scene.robot, scene.settings, workspace,
                  image);
      background.learn(scene.camera, scene.sensor_depth_m, scene.robot, image.fate, settings);
      apply_sensor_rules(scene.camera, scene.sensor_depth_m, scene.robot,
                         {.background = &background, .always_reads = true}, settings, sensor,
                         image);
    }
    return image;
  };
  const ObstacleImage one = run(1);
  const ObstacleImage three = run(3);
  EXPECT_TRUE(same_bits(one.depth_m, three.depth_m));
  EXPECT_EQ(one.fate.pixels(), three.fate.pixels());
  EXPECT_EQ(one.count, three.count);
}

}  // namespace
}  // namespace berth
