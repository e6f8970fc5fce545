// One rule after the other, on rectangles that face the camera.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "berth/self_filter/settings.hpp"
#include "tests/self_filter/flat_scene.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr PixelRect kLinkRect{20, 20, 40, 40};

PixelFate fate_of_reading(float reading_m, LinkId id, const SelfFilterSettings& settings) {
  FlatScene scene;
  scene.add_link(id, kLinkRect, 1.0F);
  scene.see(kLinkRect, reading_m);
  return filter(scene, settings).fate(30, 30);
}

TEST(SelfFilter, WithoutARobotEveryReadingIsAnObstacle) {
  FlatScene scene;
  scene.see({0, 0, 5, 5}, kNoDepth);
  const ObstacleImage out = filter(scene, {});
  EXPECT_EQ(out.count_of(PixelFate::obstacle), kSide_px * kSide_px - 25);
  EXPECT_EQ(out.count_of(PixelFate::no_reading), 25);
  EXPECT_EQ(out.depth_m(30, 30), FlatScene::kWall_m);
  EXPECT_TRUE(std::isnan(out.depth_m(2, 2)));
}

TEST(SelfFilter, CountsAddUpToTheImageAndDepthIsThereExactlyAtObstacles) {
  FlatScene scene;
  scene.add_link(1, kLinkRect, 1.0F);
  scene.add_link(kEnvironmentLink, {0, 50, 60, 60}, 1.2F);
  scene.see(kLinkRect, 1.01F);
  scene.see({0, 50, 60, 60}, 1.2F);
  scene.see({0, 0, 3, 60}, kNoDepth);
  const ObstacleImage out = filter(scene, {});
  EXPECT_EQ(std::accumulate(out.count.begin(), out.count.end(), std::int64_t{0}),
            kSide_px * kSide_px);
  for (int v = 0; v < kSide_px; ++v) {
    for (int u = 0; u < kSide_px; ++u) {
      const bool kept = out.fate(u, v) == PixelFate::obstacle;
      EXPECT_EQ(kept, !std::isnan(out.depth_m(u, v)));
      if (kept) {
        EXPECT_EQ(out.depth_m(u, v), scene.sensor_depth_m(u, v));
      }
    }
  }
}

TEST(SelfFilter, WhatIsNearTheModelOrBehindItIsRobot) {
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.04;
  EXPECT_EQ(fate_of_reading(1.0F, 1, settings), PixelFate::robot);
  EXPECT_EQ(fate_of_reading(0.961F, 1, settings), PixelFate::robot);
  EXPECT_EQ(fate_of_reading(2.5F, 1, settings), PixelFate::robot);
}

TEST(SelfFilter, WhatIsClearlyInFrontOfTheModelStays) {
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.04;
  EXPECT_EQ(fate_of_reading(0.959F, 1, settings), PixelFate::obstacle);
  EXPECT_EQ(fate_of_reading(0.2F, 1, settings), PixelFate::obstacle);
}

TEST(SelfFilter, ToleranceGrowsWithDepthAsAskedFor) {
  const auto at_two_metres = [](float reading_m, const SelfFilterSettings& settings) {
    FlatScene scene;
    scene.add_link(1, kLinkRect, 2.0F);
    scene.see(kLinkRect, reading_m);
    return filter(scene, settings).fate(30, 30);
  };
  SelfFilterSettings settings = no_rules();
  settings.tolerance_per_m2 = 0.05;
  EXPECT_EQ(at_two_metres(1.81F, settings), PixelFate::robot);
  EXPECT_EQ(at_two_metres(1.79F, settings), PixelFate::obstacle);
}

TEST(SelfFilter, EnvironmentIsFilteredAndGrownLikeALink) {
  EXPECT_EQ(fate_of_reading(1.0F, kEnvironmentLink, {}), PixelFate::environment);
  EXPECT_EQ(fate_of_reading(0.9F, kEnvironmentLink, {}), PixelFate::obstacle);
  FlatScene scene;
  scene.add_link(kEnvironmentLink, kLinkRect, 2.0F);  // a pixel is 20 mm wide there
  SelfFilterSettings settings = no_rules();
  settings.padding_m = 0.101;
  const ObstacleImage padded = filter(scene, settings);
  EXPECT_EQ(padded.fate(15, 30), PixelFate::padding);
  EXPECT_EQ(padded.fate(14, 30), PixelFate::obstacle);
}

/// A board that leans away from the camera, by 3 cm a pixel; before it a thing of one depth, whose
/// lowest pixels are the board's own.
FlatScene thing_on_board(LinkId board) {
  FlatScene scene;
  for (int v = 10; v < 50; ++v) {
    const float board_m = 2.2F - 0.03F * static_cast<float>(v);
    scene.add_link(board, {10, v, 50, v + 1}, board_m);
    scene.see({10, v, 50, v + 1}, board_m);
  }
  scene.see({28, 28, 33, 34}, 1.21F);
  return scene;
}

TEST(SelfFilter, WhatStandsOnEnvironmentIsNotPadded) {
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.05;
  settings.padding_m = 0.05;
  const ObstacleImage on_table = filter(thing_on_board(kEnvironmentLink), settings);
  EXPECT_EQ(on_table.fate(30, 32), PixelFate::environment);
  EXPECT_EQ(on_table.fate(30, 31), PixelFate::obstacle);
  // A link's surface that turns away like that grows all over.
  EXPECT_EQ(filter(thing_on_board(1), settings).fate(30, 31), PixelFate::padding);
}

TEST(SelfFilter, EnvironmentEndsAtADeeperPart) {
  FlatScene scene;
  scene.add_link(kEnvironmentLink, {10, 10, 30, 50}, 1.0F);
  scene.add_link(kEnvironmentLink, {30, 10, 50, 50}, 1.2F);
  scene.see({10, 10, 50, 50}, 1.0F);  // the sensor sees the near part wider
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.04;
  settings.padding_m = 0.035;
  const ObstacleImage out = filter(scene, settings);
  EXPECT_EQ(out.fate(32, 30), PixelFate::padding);
  EXPECT_EQ(out.fate(33, 30), PixelFate::obstacle);
}

TEST(SelfFilter, PaddingIsADiscOfThatLengthAtTheLinksDepth) {
  FlatScene scene;
  scene.add_link(1, kLinkRect, 2.0F);  // a pixel is 20 mm wide there
  SelfFilterSettings settings = no_rules();
  settings.padding_m = 0.101;
  const ObstacleImage out = filter(scene, settings);
  EXPECT_EQ(out.fate(15, 30), PixelFate::padding);
  EXPECT_EQ(out.fate(14, 30), PixelFate::obstacle);
  EXPECT_EQ(out.fate(44, 30), PixelFate::padding);
  EXPECT_EQ(out.fate(45, 30), PixelFate::obstacle);
  EXPECT_EQ(out.fate(30, 15), PixelFate::padding);
  EXPECT_EQ(out.fate(30, 14), PixelFate::obstacle);
  // Around a corner: 3 and 4 pixels are 5 away, 4 and 4 are more.
  EXPECT_EQ(out.fate(17, 16), PixelFate::padding);
  EXPECT_EQ(out.fate(16, 16), PixelFate::obstacle);
}

/// A link before the wall; beside it a thing at this depth, and one mixed pixel at 2 m.
FlatScene scene_beside_link(float thing_depth_m) {
  FlatScene scene;
  scene.add_link(1, kLinkRect, 1.0F);
  scene.see(kLinkRect, 1.0F);
  scene.see({40, 20, 44, 30}, thing_depth_m);
  scene.see({41, 35, 42, 36}, 2.0F);
  return scene;
}

TEST(SelfFilter, PaddingTakesNoSurfaceThatIsSeenFartherBehindTheRobot) {
  SelfFilterSettings settings = no_rules();
  settings.padding_m = 0.05;
  settings.padding_depth_m = 0.3;
  const ObstacleImage near = filter(scene_beside_link(1.29F), settings);
  const ObstacleImage far = filter(scene_beside_link(1.31F), settings);
  EXPECT_EQ(near.fate(42, 25), PixelFate::padding);
  EXPECT_EQ(far.fate(42, 25), PixelFate::obstacle);
  EXPECT_EQ(far.depth_m(42, 25), 1.31F);
  EXPECT_EQ(far.fate(40, 25), PixelFate::obstacle) << "next to the link";
  EXPECT_EQ(far.fate(42, 38), PixelFate::obstacle) << "the wall";
  settings.padding_depth_m = 0.32;
  EXPECT_EQ(filter(scene_beside_link(1.31F), settings).fate(42, 25), PixelFate::padding);
}

TEST(SelfFilter, PaddingTakesAMixedPixelHoweverFarBehind) {
  SelfFilterSettings settings = no_rules();
  settings.padding_depth_m = 0.3;
  EXPECT_EQ(filter(scene_beside_link(1.31F), settings).fate(41, 35), PixelFate::obstacle);
  settings.padding_m = 0.05;
  EXPECT_EQ(filter(scene_beside_link(1.31F), settings).fate(41, 35), PixelFate::padding);
  EXPECT_EQ(filter(scene_beside_link(1.31F), settings).fate(41, 38), PixelFate::obstacle);
}

TEST(SelfFilter, PaddingOfASingleLinkReplacesTheCommonOne) {
  FlatScene scene;
  scene.add_link(1, {5, 20, 20, 40}, 1.0F);
  scene.add_link(2, {40, 20, 55, 40}, 1.0F);
  SelfFilterSettings settings = no_rules();
  settings.padding_m = 0.02;
  settings.link_padding_m = {std::numeric_limits<double>::quiet_NaN(), 0.05};
  const ObstacleImage out = filter(scene, settings);
  EXPECT_EQ(out.fate(21, 30), PixelFate::padding);
  EXPECT_EQ(out.fate(22, 30), PixelFate::obstacle);
  EXPECT_EQ(out.fate(35, 30), PixelFate::padding);
  EXPECT_EQ(out.fate(34, 30), PixelFate::obstacle);
}

TEST(SelfFilter, AnObstacleInFrontOfThePaddingStays) {
  FlatScene scene;
  scene.add_link(1, kLinkRect, 1.0F);
  scene.see({40, 20, 42, 40}, 0.9F);
  SelfFilterSettings settings = no_rules();
  settings.padding_m = 0.05;
  settings.tolerance_m = 0.04;
  EXPECT_EQ(filter(scene, settings).fate(41, 30), PixelFate::obstacle);
  EXPECT_EQ(filter(scene, settings).fate(43, 30), PixelFate::padding);
}

TEST(SelfFilter, ANearLinkGrowsOverADeeperOne) {
  FlatScene scene;
  scene.add_link(1, {10, 10, 50, 50}, 1.5F);
  scene.add_link(2, kLinkRect, 1.0F);
  scene.see({10, 10, 50, 50}, 1.5F);
  scene.see({20, 20, 42, 40}, 1.0F);  // the sensor sees the near link two pixels wider
  SelfFilterSettings settings = no_rules();
  settings.tolerance_m = 0.04;
  EXPECT_EQ(filter(scene, settings).fate(41, 30), PixelFate::obstacle);
  settings.padding_m = 0.025;
  EXPECT_EQ(filter(scene, settings).fate(41, 30), PixelFate::padding);
  EXPECT_EQ(filter(scene, settings).fate(43, 30), PixelFate::robot);
}

TEST(SelfFilter, ASlopeIsNoMixedPixel) {
  FlatScene scene;
  for (int u = 0; u < kSide_px; ++u)
    scene.see({u, 0, u + 1, kSide_px}, 1.0F + 0.05F * static_cast<float>(u));
  EXPECT_EQ(filter(scene, {}).count_of(PixelFate::obstacle), kSide_px * kSide_px);
}

TEST(SelfFilter, SettingsThatReachFartherNeverKeepMore) {
  FlatScene scene;
  scene.add_link(1, kLinkRect, 1.0F);
  scene.see({18, 18, 43, 41}, 1.02F);
  std::int64_t last = kSide_px * kSide_px;
  for (const double scale : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    SelfFilterSettings settings;
    settings.tolerance_m *= scale;
    settings.padding_m *= scale;
    const std::int64_t kept = filter(scene, settings).count_of(PixelFate::obstacle);
    EXPECT_LE(kept, last);
    last = kept;
  }
}

TEST(SelfFilter, MemoryOfFormerFramesDoesNotShow) {
  FlatScene first;
  first.add_link(1, kLinkRect, 1.0F);
  first.see({35, 18, 48, 41}, 1.0F);
  FlatScene second;
  second.add_link(2, {0, 0, 60, 10}, 0.5F);
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  const auto run = [&](const FlatScene& scene) {
    self_filter(flat_camera(), scene.sensor_depth_m, scene.robot, {}, workspace, out);
    return out.fate.pixels();
  };
  const auto fresh_first = filter(first, {}).fate.pixels();
  const auto fresh_second = filter(second, {}).fate.pixels();
  EXPECT_EQ(run(first), fresh_first);
  EXPECT_EQ(run(second), fresh_second);
  EXPECT_EQ(run(first), fresh_first);
}

TEST(SelfFilter, OnePixelAndNoPixelSeenWork) {
  const Camera camera{1, 1, 100, 100, 0, 0};
  RobotImage robot{DepthImage(1, 1, 1.0F), Image<LinkId>(1, 1, 1)};
  SelfFilterWorkspace workspace;
  ObstacleImage out;
  self_filter(camera, DepthImage(1, 1, 0.5F), robot, {}, workspace, out);
  EXPECT_EQ(out.fate(0, 0), PixelFate::obstacle);
  self_filter(camera, DepthImage(1, 1, kNoDepth), robot, {}, workspace, out);
  EXPECT_EQ(out.fate(0, 0), PixelFate::no_reading);
}

std::string message_for(const std::function<void(SelfFilterSettings&)>& spoil) {
  SelfFilterSettings settings;
  spoil(settings);
  return error_message<std::invalid_argument>([&] { validate(settings); });
}

TEST(SelfFilterSettings, DefaultsAreValid) { EXPECT_NO_THROW(validate(SelfFilterSettings{})); }

TEST(SelfFilterSettings, EachKeyOutsideItsDomainIsNamed) {
  using Settings = SelfFilterSettings;
  const std::pair<const char*, std::function<void(Settings&)>> cases[] = {
      {"tolerance_m: -0.1", [](Settings& s) { s.tolerance_m = -0.1; }},
      {"tolerance_per_m2: inf",
       [](Settings& s) { s.tolerance_per_m2 = std::numeric_limits<double>::infinity(); }},
      {"padding_m: nan",
       [](Settings& s) { s.padding_m = std::numeric_limits<double>::quiet_NaN(); }},
      {"link_padding_m: -0.5",
       [](Settings& s) {
         s.link_padding_m = {0.1, -0.5};
       }},
      {"surface_tolerance_m: -1", [](Settings& s) { s.surface_tolerance_m = -1; }},
      {"flying_patch_radius_m: -1", [](Settings& s) { s.flying_patch_radius_m = -1; }},
      {"robot_region_scale: 0.99", [](Settings& s) { s.robot_region_scale = 0.99; }},
  };
  for (const auto& [expected, spoil] : cases) {
    EXPECT_NE(message_for(spoil).find(expected), std::string::npos)
        << expected << " not in: " << message_for(spoil);
    EXPECT_NE(message_for(spoil).find("expected"), std::string::npos);
  }
}

}  // namespace
}  // namespace berth
