#include "berth/sensor/holes.hpp"

#include <gtest/gtest.h>

#include "berth/sensor/background.hpp"
#include "tests/sensor/images.hpp"

namespace berth {
namespace {

constexpr int kSide_px = 60;
/// At 1 m a pixel is 10 mm wide.
Camera camera() { return {kSide_px, kSide_px, 100, 100, 30, 30}; }

RobotImage no_robot() {
  return {DepthImage(kSide_px, kSide_px, kNoDepth), Image<LinkId>(kSide_px, kSide_px, kNoLink)};
}

/// A link of 10 x 10 pixels at 1 m, at (20, 20).
RobotImage with_link(LinkId id) {
  RobotImage robot = no_robot();
  for (int v = 20; v < 30; ++v) {
    for (int u = 20; u < 30; ++u) {
      robot.link_id(u, v) = id;
      robot.depth_m(u, v) = 1.0F;
    }
  }
  return robot;
}

/// Nothing is read; the empty cell has readings in the columns from 10 on, of 3 m, and from 50 on
/// at unknown depths.
class Holes : public ::testing::Test {
 protected:
  Holes() : nothing_m_(kSide_px, kSide_px, kNoDepth) {
    DepthImage cell_m(kSide_px, kSide_px, kNoDepth);
    for (int v = 0; v < kSide_px; ++v) {
      for (int u = 10; u < kSide_px; ++u) cell_m(u, v) = u < 50 ? 3.0F : HUGE_VALF;
    }
    background_.assign(cell_m, settings_);
  }

  ObstacleImage found(const RobotImage& robot, const KnownPlace& place,
                      const DepthImage& depth_m) const {
    ObstacleImage image = kept_image(depth_m);
    HolesWorkspace workspace;
    find_holes(camera(), depth_m, robot, place, settings_, workspace, image);
    return image;
  }
  ObstacleImage found(const RobotImage& robot, const KnownPlace& place) const {
    return found(robot, place, nothing_m_);
  }

  SensorSettings settings_{.background_frames = 2};
  Background background_;
  DepthImage nothing_m_;
};

TEST_F(Holes, AreWhereTheEmptyCellHasAReading) {
  DepthImage depth_m = nothing_m_;
  depth_m(15, 5) = 2.0F;
  const ObstacleImage image = found(no_robot(), {.background = &background_}, depth_m);
  EXPECT_EQ(image.fate(9, 5), PixelFate::no_reading);
  EXPECT_EQ(image.fate(10, 5), PixelFate::hole);
  EXPECT_EQ(image.fate(55, 5), PixelFate::hole) << "of whatever depth";
  EXPECT_EQ(image.fate(15, 5), PixelFate::obstacle);
}

TEST_F(Holes, AreWhereNoReadingSaysSo) {
  EXPECT_EQ(found(no_robot(), {}).fate(30, 30), PixelFate::no_reading);
  EXPECT_EQ(found(no_robot(), {.always_reads = true}).fate(5, 5), PixelFate::hole);
  EXPECT_EQ(found(with_link(kEnvironmentLink), {.always_reads = true}).fate(25, 25),
            PixelFate::no_reading);
}

TEST_F(Holes, AreNotAtTheRobotNorInItsShadow) {
  for (const bool always_reads : {false, true}) {
    const ObstacleImage image =
        found(with_link(1), {.background = &background_, .always_reads = always_reads});
    EXPECT_EQ(image.fate(25, 25), PixelFate::no_reading);
    EXPECT_EQ(image.fate(29 + 6, 25), PixelFate::no_reading);  // 6 cm at 1 m
    EXPECT_EQ(image.fate(29 + 7, 25), PixelFate::hole);
  }
}

TEST_F(Holes, AreOnALinkWhereABallFits) {
  const auto fate_in_middle_of = [&](int lost_px, const KnownPlace& place) {
    DepthImage depth_m = nothing_m_;
    for (int v = 20; v < 30; ++v) {
      for (int u = 20; u < 30; ++u) depth_m(u, v) = 1.0F;
    }
    for (int v = 22; v < 22 + lost_px; ++v) {
      for (int u = 22; u < 22 + lost_px; ++u) depth_m(u, v) = kNoDepth;
    }
    return found(with_link(1), place, depth_m).fate(24, 24);
  };
  // Behind a link that never moves nobody has seen the cell.
  for (const KnownPlace& place :
       {KnownPlace{.background = &background_}, KnownPlace{.always_reads = true}}) {
    EXPECT_EQ(fate_in_middle_of(4, place), PixelFate::no_reading);
    EXPECT_EQ(fate_in_middle_of(5, place), PixelFate::hole);  // 4 cm at 1 m
    EXPECT_EQ(fate_in_middle_of(8, place), PixelFate::no_reading) << "a link that is black";
  }
}

TEST_F(Holes, AreOnEnvironment) {
  const ObstacleImage image = found(with_link(kEnvironmentLink), {.background = &background_});
  EXPECT_EQ(image.fate(25, 25), PixelFate::hole);
}

TEST_F(Holes, KeepWhatTheBackgroundPutThere) {
  ObstacleImage image = kept_image(nothing_m_);
  const KnownPlace place{.background = &background_};
  background_.complete(nothing_m_, place, settings_, image);
  HolesWorkspace workspace;
  find_holes(camera(), nothing_m_, with_link(1), place, settings_, workspace, image);
  EXPECT_EQ(image.fate(45, 45), PixelFate::hole);
  EXPECT_EQ(image.depth_m(45, 45), 3.0F);
  EXPECT_EQ(image.fate(25, 25), PixelFate::background);
  EXPECT_EQ(image.depth_m(25, 25), 3.0F);
}

}  // namespace
}  // namespace berth
