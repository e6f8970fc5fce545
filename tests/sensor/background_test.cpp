#include "berth/sensor/background.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sensor/images.hpp"

namespace berth {
namespace {

constexpr int kSide_px = 60;
constexpr float kWall_m = 3.0F;

/// At 1 m a pixel is 10 mm wide.
Camera camera() { return {kSide_px, kSide_px, 100, 100, 30, 30}; }

template <class T>
void fill(Image<T>& image, const PixelRect& pixels, T value) {
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) image(u, v) = value;
  }
}

RobotImage no_robot() {
  return {DepthImage(kSide_px, kSide_px, kNoDepth), Image<LinkId>(kSide_px, kSide_px, kNoLink)};
}

/// A link of 10 x 10 pixels at 1 m.
RobotImage robot_at(int u_begin, int v_begin, LinkId id = 1) {
  RobotImage robot = no_robot();
  const PixelRect pixels{u_begin, v_begin, u_begin + 10, v_begin + 10};
  fill(robot.depth_m, pixels, 1.0F);
  fill(robot.link_id, pixels, id);
  return robot;
}

DepthImage wall() { return DepthImage(kSide_px, kSide_px, kWall_m); }

SensorSettings with_background(int frames) {
  SensorSettings settings;
  settings.background_frames = frames;
  return settings;
}

struct Place {
  SensorSettings settings = with_background(2);
  Background background;

  void learn(const DepthImage& depth_m, const RobotImage& robot) {
    background.learn(camera(), depth_m, robot, kept_image(depth_m).fate, settings);
  }
  float at(int u, int v) const { return background.depth_m(u, v, settings); }
  bool is_known(int u, int v) const { return std::isfinite(at(u, v)); }
};

/// A place whose wall is known everywhere.
struct LearnedPlace : Place {
  LearnedPlace() {
    learn(wall(), no_robot());
    learn(wall(), no_robot());
  }
};

TEST(Background, IsKnownOnceEnoughImagesAgreeAndIsTheLeastOfThem) {
  Place place;
  place.learn(wall(), no_robot());
  EXPECT_TRUE(std::isnan(place.at(5, 5)));
  place.learn(DepthImage(kSide_px, kSide_px, 2.95F), no_robot());
  EXPECT_EQ(place.at(5, 5), 2.95F);
  place.learn(wall(), no_robot());
  EXPECT_EQ(place.at(5, 5), 2.95F);
}

TEST(Background, BeginsAnewWhereAReadingDisagrees) {
  LearnedPlace place;
  place.learn(DepthImage(kSide_px, kSide_px, 2.5F), no_robot());
  EXPECT_TRUE(std::isinf(place.at(5, 5))) << "a reading, but of which depth?";
  place.learn(DepthImage(kSide_px, kSide_px, 2.5F), no_robot());
  EXPECT_EQ(place.at(5, 5), 2.5F);
}

TEST(Background, IsNotLearnedNearTheRobotAtAnyDepth) {
  Place place;
  DepthImage depth_m = wall();
  fill(depth_m, {35, 20, 37, 22}, 0.5F);  // a hand in front of the arm's neighbourhood
  for (int i = 0; i < 2; ++i) place.learn(depth_m, robot_at(20, 20));
  EXPECT_TRUE(std::isnan(place.at(25, 25)));
  EXPECT_FALSE(place.is_known(36, 21));
  EXPECT_FALSE(place.is_known(29 + 15, 25));  // 0.15 m at 1 m is 15 px
  EXPECT_EQ(place.at(29 + 16, 25), kWall_m);
}

TEST(Background, TellsNearTheRobotWhetherThereIsAReading) {
  Place place;
  for (int i = 0; i < 2; ++i) place.learn(wall(), robot_at(20, 20));
  EXPECT_TRUE(std::isnan(place.at(29 + 6, 25))) << "the robot's shadow";
  EXPECT_TRUE(std::isinf(place.at(29 + 7, 25)));
  Place again;
  again.background.assign(place.background.learned_m(camera(), place.settings), again.settings);
  EXPECT_TRUE(std::isnan(again.at(29 + 6, 25)));
  EXPECT_TRUE(std::isinf(again.at(29 + 7, 25)));
  EXPECT_EQ(again.at(29 + 16, 25), kWall_m);
}

TEST(Background, ClearanceIsASetting) {
  Place place;
  place.settings.background_clearance_m = 0.03;
  for (int i = 0; i < 2; ++i) place.learn(wall(), robot_at(20, 20));
  EXPECT_FALSE(place.is_known(29 + 3, 25));
  EXPECT_EQ(place.at(29 + 4, 25), kWall_m);
}

TEST(Background, IsLearnedFromTheRobotsOtherPlaces) {
  Place place;
  for (const int u : {2, 48, 2, 48}) place.learn(wall(), robot_at(u, 25));
  EXPECT_EQ(place.at(50, 30), kWall_m);
  EXPECT_EQ(place.at(5, 30), kWall_m);
}

TEST(Background, IsNotLearnedFromWhatTheSelfFilterDropped) {
  Place place;
  Image<PixelFate> fates(kSide_px, kSide_px, PixelFate::obstacle);
  fates(5, 5) = PixelFate::padding;
  fates(6, 5) = PixelFate::flying_patch;
  for (int i = 0; i < 2; ++i)
    place.background.learn(camera(), wall(), no_robot(), fates, place.settings);
  EXPECT_FALSE(place.is_known(5, 5));
  EXPECT_FALSE(place.is_known(6, 5));
  EXPECT_EQ(place.at(7, 5), kWall_m);
}

TEST(Background, EnvironmentIsLearned) {
  Place place;
  const Image<PixelFate> fates(kSide_px, kSide_px, PixelFate::environment);
  for (int i = 0; i < 2; ++i)
    place.background.learn(camera(), wall(), no_robot(), fates, place.settings);
  EXPECT_EQ(place.at(5, 5), kWall_m);
}

TEST(Background, WhatStandsOnEnvironmentIsLearned) {
  Place place;
  DepthImage depth_m = wall();
  fill(depth_m, {20, 20, 30, 30}, 0.8F);
  for (int i = 0; i < 2; ++i) place.learn(depth_m, robot_at(20, 20, kEnvironmentLink));
  EXPECT_EQ(place.at(25, 25), 0.8F);
}

/// F of one image: the robot's pixels dropped, and what the background made of it.
ObstacleImage completed(const Place& place, const DepthImage& depth_m, const RobotImage& robot,
                        const SelfFilterSettings& settings = {}, const KnownPlace& known = {}) {
  SelfFilterWorkspace workspace;
  ObstacleImage image;
  self_filter(camera(), depth_m, robot, settings, workspace, image);
  place.background.complete(depth_m, known, place.settings, image);
  return image;
}

/// The robot as the sensor sees it before the wall.
DepthImage wall_and_robot(const RobotImage& robot) {
  DepthImage depth_m = wall();
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (robot.link_id.pixels()[i] != kNoLink) depth_m.pixels()[i] = robot.depth_m.pixels()[i];
  }
  return depth_m;
}

TEST(Background, IsPutBehindTheRobotAndInItsPaddingAndWhereThereIsNoReading) {
  const RobotImage robot = robot_at(20, 20);
  DepthImage depth_m = wall_and_robot(robot);
  depth_m(50, 50) = kNoDepth;
  SelfFilterSettings settings;
  settings.padding_depth_m = kWall_m;
  const ObstacleImage image = completed(LearnedPlace(), depth_m, robot, settings);
  for (const Pixel p : {Pixel{25, 25}, Pixel{31, 25}, Pixel{50, 50}}) {
    EXPECT_EQ(image.fate(p.u, p.v), PixelFate::background) << p.u;
    EXPECT_EQ(image.depth_m(p.u, p.v), kWall_m);
  }
  EXPECT_EQ(image.fate(5, 5), PixelFate::obstacle);
}

TEST(Background, RestoresAThingBesideTheArmThatTheFlyingPatchRuleDrops) {
  Place place;
  DepthImage peg = wall();
  fill(peg, {33, 24, 36, 27}, 1.03F);
  place.learn(peg, no_robot());
  place.learn(peg, no_robot());
  const RobotImage robot = robot_at(20, 20);
  DepthImage depth_m = wall_and_robot(robot);
  // Joined to the arm, through its padding too, and in a wide hole: nobody can tell what it is.
  fill(depth_m, {30, 20, 42, 31}, kNoDepth);
  fill(depth_m, {30, 24, 36, 27}, 1.015F);
  EXPECT_EQ(completed(Place(), depth_m, robot).fate(34, 25), PixelFate::flying_patch);
  const ObstacleImage image = completed(place, depth_m, robot);
  EXPECT_EQ(image.fate(34, 25), PixelFate::background);
  EXPECT_EQ(image.depth_m(34, 25), 1.03F);
}

TEST(Background, NeverReplacesWhatIsKept) {
  // A new thing beside the arm, or a piece that the sensor made up there: the same image.
  const RobotImage robot = robot_at(20, 20);
  DepthImage depth_m = wall_and_robot(robot);
  fill(depth_m, {33, 10, 55, 40}, 1.03F);
  const ObstacleImage image = completed(LearnedPlace(), depth_m, robot);
  EXPECT_EQ(image.fate(40, 25), PixelFate::obstacle);
  EXPECT_EQ(image.depth_m(40, 25), 1.03F);
}

TEST(Background, IsNotPutWhereAReadingComesFromBehindIt) {
  Place place;
  DepthImage box = wall();
  fill(box, {15, 15, 40, 40}, 0.7F);
  place.learn(box, no_robot());
  place.learn(box, no_robot());
  const RobotImage robot = robot_at(20, 20);
  // The box is gone: the robot that stood behind it is seen.
  const ObstacleImage image = completed(place, wall_and_robot(robot), robot);
  EXPECT_EQ(image.fate(25, 25), PixelFate::robot);
  EXPECT_TRUE(std::isnan(image.depth_m(25, 25)));
}

TEST(Background, IsNotPutOntoEnvironment) {
  const RobotImage robot = robot_at(20, 20, kEnvironmentLink);
  const ObstacleImage image = completed(LearnedPlace(), wall_and_robot(robot), robot);
  EXPECT_EQ(image.fate(25, 25), PixelFate::environment);
}

TEST(Background, IsNotPutWhereTheRobotHidesEnvironment) {
  const RobotImage robot = robot_at(20, 20);
  const auto fate_before = [&](float environment_m) {
    const DepthImage environment(kSide_px, kSide_px, environment_m);
    return completed(LearnedPlace(), wall_and_robot(robot), robot, {},
                     {.environment_m = environment, .tolerance = {0.05F, 0}})
        .fate(25, 25);
  };
  EXPECT_EQ(fate_before(kWall_m + 0.04F), PixelFate::robot);
  EXPECT_EQ(fate_before(kWall_m - 0.5F), PixelFate::robot) << "seen past an edge";
  EXPECT_EQ(fate_before(kWall_m + 0.06F), PixelFate::background) << "stands on it";
  EXPECT_EQ(fate_before(kNoDepth), PixelFate::background);
}

TEST(Background, OfAnotherSizeIsForgotten) {
  LearnedPlace place;
  const Camera other{30, 30, 100, 100, 15, 15};
  const DepthImage depth_m(30, 30, 2.0F);
  const RobotImage robot{DepthImage(30, 30, kNoDepth), Image<LinkId>(30, 30, kNoLink)};
  place.background.learn(other, depth_m, robot, kept_image(depth_m).fate, place.settings);
  EXPECT_TRUE(std::isnan(place.at(5, 5)));
}

}  // namespace
}  // namespace berth
