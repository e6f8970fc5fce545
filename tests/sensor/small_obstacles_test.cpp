// A rod and a finger near the arm, seen by a bad sensor, with every rule as strong as its
// documentation allows: what the filter leaves of them gives their distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/sensor_model.hpp"
#include "tests/support/known_arms.hpp"
#include "thesis/evaluate.hpp"

namespace berth::testing {
namespace {

/// The speckle rule's documented limit.
constexpr int kMostSpeckle_px = 60;
constexpr int kFrames = 3;
/// A distance to what is left of the thing may be larger by this much.
constexpr double kBound_m = 0.005;
/// A reading nearer to the robot's visible surface than this may be a flying patch of the self
/// filter.
constexpr double kClearance_m = 0.1;

struct Shape {
  double diameter_m;
  double length_m;
};
/// Their sizes at 1.5 m with a focal length of 600 px; elsewhere as large in the image.
constexpr Shape kRod{0.010, 0.200};
constexpr Shape kFinger{0.015, 0.070};

SensorSettings strongest_rules() {
  SensorSettings settings;
  settings.speckle_px = kMostSpeckle_px;
  settings.background_frames = 1;
  return settings;
}

DepthImage spoiled(DepthImage depth_m, std::uint32_t seed) {
  sim::mix_edge_pixels(0.5, seed, depth_m);
  sim::darken_outlines(2, depth_m);
  sim::add_noise(0.002, seed + 1, depth_m);
  sim::quantise(0.001, depth_m);
  sim::drop_out(0.02, seed + 2, depth_m);
  return depth_m;
}

Eigen::Vector3d point_C(const Camera& camera, int u, int v, double z) {
  return {(u - camera.cx_px) * z / camera.fx_px, (v - camera.cy_px) * z / camera.fy_px, z};
}

/// The thing's depth where it hides all else, NaN elsewhere.
struct Thing {
  DepthImage visible_m;
  int pixels = 0;
};

class SmallObstacles : public ::testing::TestWithParam<Shape> {
 protected:
  /// A thing near a random pixel of the robot; nothing where it would be too near to the robot,
  /// where less than two thirds of it can be seen, or where the image's border cuts it.
  std::optional<Thing> place(const sim::DrawnScene& scene, sim::Random& random) const {
    const Camera& camera = scene.camera;
    const int u = random.whole(0, camera.width_px - 1);
    const int v = random.whole(0, camera.height_px - 1);
    if (scene.robot.link_id(u, v) == kNoLink || scene.robot.link_id(u, v) == kEnvironmentLink)
      return {};
    Eigen::Vector3d offset = sim::draw_rotation(random) * Eigen::Vector3d::UnitX();
    offset.z() = -std::abs(offset.z());
    const Eigen::Vector3d p_C =
        point_C(camera, u, v, scene.robot.depth_m(u, v)) + random(0.1, 0.35) * offset;
    const double scale = p_C.z() / 1.5 * 600 / camera.fx_px;
    if (p_C.z() < 0.3) return {};
    const double length_m = scale * GetParam().length_m;
    if (distance_to_robot_m(scene, p_C) < kClearance_m + length_m / 2) return {};
    const Pose X_CO =
        Eigen::Translation3d(p_C) *
        Eigen::AngleAxisd(random(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(random(0.25, 0.75) * std::numbers::pi, Eigen::Vector3d::UnitX());
    return seen(scene,
                {make_cylinder(scale * GetParam().diameter_m / 2, length_m), scene.X_BC * X_CO});
  }

  static std::optional<Thing> seen(const sim::DrawnScene& scene,
                                   const sim::DrawnObstacle& obstacle) {
    RobotImage image;
    RobotRenderer(build_link_meshes(sim::obstacle_model({obstacle})), scene.camera)
        .render(sim::obstacle_pose({obstacle}), scene.X_BC, image);
    if (touches_border(image)) return {};
    Thing thing{image.depth_m, 0};
    int drawn = 0;
    for (std::size_t i = 0; i < image.depth_m.pixels().size(); ++i) {
      float& z = thing.visible_m.pixels()[i];
      if (std::isnan(z)) continue;
      ++drawn;
      if (scene.depth_m.pixels()[i] <= z) z = kNoDepth;
      thing.pixels += !std::isnan(z);
    }
    if (thing.pixels == 0 || 3 * thing.pixels < 2 * drawn) return {};
    return thing;
  }

  static bool touches_border(const RobotImage& image) {
    const int last_u = image.link_id.width() - 1;
    const int last_v = image.link_id.height() - 1;
    for (int u = 0; u <= last_u; ++u) {
      if (image.link_id(u, 0) != kNoLink || image.link_id(u, last_v) != kNoLink) return true;
    }
    for (int v = 0; v <= last_v; ++v) {
      if (image.link_id(0, v) != kNoLink || image.link_id(last_u, v) != kNoLink) return true;
    }
    return false;
  }

  static double distance_to_robot_m(const sim::DrawnScene& scene, const Eigen::Vector3d& p_C) {
    double least_m = std::numeric_limits<double>::infinity();
    for (int v = 0; v < scene.camera.height_px; v += 4) {
      for (int u = 0; u < scene.camera.width_px; u += 4) {
        if (scene.robot.link_id(u, v) == kNoLink) continue;
        const double z = scene.robot.depth_m(u, v);
        least_m = std::min(least_m, (point_C(scene.camera, u, v, z) - p_C).norm());
      }
    }
    return least_m;
  }

  std::vector<LinkDistance> distances(const sim::DrawnScene& scene,
                                      const DepthImage& obstacles_m) const {
    SearchableDepth searchable;
    searchable.build(obstacles_m);
    ImageDistanceSettings settings;
    settings.mean_direction = false;
    EvaluateWorkspace workspace;
    LinkDistances out;
    evaluate(Method::exact, {scene.camera, scene.robot, model_.link_count(), searchable, settings},
             workspace, out);
    return out.links;
  }

  /// The part of the thing that is left after all rules, by its own readings.
  static DepthImage left_of(const sim::DrawnScene& scene, const Thing& thing, std::uint32_t seed) {
    DepthImage depth_m = scene.depth_m;
    for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
      if (!std::isnan(thing.visible_m.pixels()[i]))
        depth_m.pixels()[i] = thing.visible_m.pixels()[i];
    }
    const SensorSettings settings = strongest_rules();
    SelfFilterWorkspace workspace;
    SensorWorkspace sensor;
    Background background;
    ObstacleImage image;
    const auto filter = [&](const DepthImage& sensor_m) {
      self_filter(scene.camera, sensor_m, scene.robot, {}, workspace, image);
    };
    const DepthImage before_it_came_m = spoiled(scene.depth_m, seed);
    filter(before_it_came_m);
    background.learn(scene.camera, before_it_came_m, scene.robot, image.fate, settings);
    for (std::uint32_t frame = 1; frame <= kFrames; ++frame) {
      const DepthImage sensor_m = spoiled(depth_m, seed + 10 * frame);
      filter(sensor_m);
      apply_sensor_rules(scene.camera, sensor_m, scene.robot, {.background = &background}, settings,
                         sensor, image);
    }
    for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
      const PixelFate fate = image.fate.pixels()[i];
      if (fate != PixelFate::obstacle || std::isnan(thing.visible_m.pixels()[i]))
        image.depth_m.pixels()[i] = kNoDepth;
    }
    return image.depth_m;
  }

  const RobotModel model_ = load_robot(bundled_arm());
  const std::vector<sim::MeshTree> trees_ = sim::build_link_trees(model_);
};

TEST_P(SmallObstacles, KeepTheirDistanceUnderTheStrongestRules) {
  int things = 0;
  int links = 0;
  double largest_m = 0;
  int least_px = std::numeric_limits<int>::max();
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const sim::DrawnScene scene = sim::draw_scene(model_, trees_, {.most_obstacles = 4}, seed);
    sim::Random random(seed);
    for (int attempt = 0, in_scene = 0; attempt < 3000 && in_scene < 5; ++attempt) {
      const std::optional<Thing> thing = place(scene, random);
      if (!thing) continue;
      SCOPED_TRACE(fmt::format("seed {}, attempt {}", seed, attempt));
      ++in_scene;
      ++things;
      least_px = std::min(least_px, thing->pixels);
      const auto truth = distances(scene, thing->visible_m);
      const auto found = distances(scene, left_of(scene, *thing, 1000 * seed + attempt));
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (!(truth[i].distance_m + kBound_m < DistanceSettings().range_m)) continue;
        ++links;
        ASSERT_EQ(found[i].status, LinkStatus::ok)
            << "link " << i + 1 << " at " << truth[i].distance_m;
        EXPECT_LE(found[i].distance_m, truth[i].distance_m + kBound_m) << "link " << i + 1;
        largest_m = std::max(largest_m, double{found[i].distance_m} - truth[i].distance_m);
      }
    }
  }
  fmt::print("{} things of at least {} px, {} links: distances at most {:.1f} mm too large\n",
             things, least_px, links, 1e3 * largest_m);
  EXPECT_GE(things, 20);
}

INSTANTIATE_TEST_SUITE_P(Shapes, SmallObstacles, ::testing::Values(kRod, kFinger),
                         [](const auto& test) { return test.index == 0 ? "Rod" : "Finger"; });

}  // namespace
}  // namespace berth::testing
