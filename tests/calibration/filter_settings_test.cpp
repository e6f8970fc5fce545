#include "berth/calibration/filter_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "sim/sensor_model.hpp"
#include "tests/calibration/arms.hpp"

namespace berth {
namespace {

/// NaN where it is not proposed.
double value_of(const std::vector<ProposedSetting>& settings, const std::string& key) {
  for (const ProposedSetting& one : settings) {
    if (one.key == key) return one.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Frames of an ideal camera whose pose is known.
class FilterProposalOf : public ::testing::Test {
 protected:
  FilterProposalOf() {
    RobotRenderer renderer(coarse_arm().meshes, camera().camera);
    for (const CalibrationFrame& frame : camera().frames) {
      RobotPose pose;
      forward_kinematics(coarse_arm().model, frame.joints.position, pose);
      renderer.render(pose, drawn_.X_PC_true, robots_.emplace_back());
    }
  }

  CalibrationCamera& camera() { return *drawn_.camera; }

  FilterProposal propose(const SensorSettings& sensor = {}, bool corrects_depth = false) {
    return propose_filter(drawn_.calibration_data, 0, found_, corrects_depth, {}, sensor);
  }

  static bool is_arm(LinkId id) { return id != kNoLink && id != kEnvironmentLink; }

  /// The camera sees the arm wider than it is, by this on each side.
  void draw_flying_pixels(int width_px) {
    for (std::size_t f = 0; f < robots_.size(); ++f) {
      const RobotImage& robot = robots_[f];
      DepthImage& depth_m = camera().frames[f].depth_m;
      for (int v = 0; v < depth_m.height(); ++v) {
        for (int u = 0; u < depth_m.width(); ++u) {
          if (!is_arm(robot.link_id(u, v))) continue;
          const PixelRect near =
              clip({u - width_px, v - width_px, u + width_px + 1, v + width_px + 1},
                   depth_m.width(), depth_m.height());
          for (int b = near.v_begin; b < near.v_end; ++b) {
            for (int a = near.u_begin; a < near.u_end; ++a) {
              if (std::hypot(a - u, b - v) > width_px || robot.link_id(a, b) != kNoLink) continue;
              depth_m(a, b) = std::fmin(depth_m(a, b), robot.depth_m(u, v));
            }
          }
        }
      }
    }
  }

  /// A thing of width_px x height_px in one frame, 6 cm before the arm, where the arm is wide.
  void draw_blob(std::size_t frame, int width_px, int height_px) {
    const RobotImage& robot = robots_[frame];
    for (int v = 0; v + height_px < robot.link_id.height(); ++v) {
      for (int u = 0; u + width_px < robot.link_id.width(); ++u) {
        bool is_free = true;
        for (int b = v; b < v + height_px; ++b) {
          for (int a = u; a < u + width_px; ++a) is_free &= is_arm(robot.link_id(a, b));
        }
        if (!is_free) continue;
        const float z_m = robot.depth_m(u, v) - 0.06F;
        for (int b = v; b < v + height_px; ++b) {
          for (int a = u; a < u + width_px; ++a) camera().frames[frame].depth_m(a, b) = z_m;
        }
        return;
      }
    }
    FAIL() << "no room";
  }

  sim::DrawnCalibrationData drawn_ = coarse_arm().draw({.poses = 3, .has_sensor_errors = false}, 2);
  CalibrationResult found_ = true_result(drawn_);
  std::vector<RobotImage> robots_;
};

TEST_F(FilterProposalOf, AnIdealCameraNeedsTheLeast) {
  const FilterProposal found = propose();
  EXPECT_EQ(value_of(found.self_filter, "tolerance_m"), 0.02);
  EXPECT_EQ(value_of(found.self_filter, "padding_m"), 0.02);
  EXPECT_TRUE(found.sensor.empty());
  EXPECT_NEAR(found.bias_m, 0, 1e-4);
  EXPECT_EQ(found.leftover_px, 0);
  EXPECT_EQ(found.largest_leftover_px, 0);
  ASSERT_EQ(found.smallest.size(), 3U);
  EXPECT_EQ(found.smallest[0].depth_m, 1);
  EXPECT_EQ(found.smallest[1].depth_m, 1.5);
  EXPECT_EQ(found.smallest[2].depth_m, 2);
  for (const ProposedSetting& one : found.self_filter) EXPECT_NE(one.why, "");
}

TEST_F(FilterProposalOf, TheToleranceGrowsWithTheNoise) {
  double before_m = value_of(propose().self_filter, "tolerance_m");
  for (const double deviation_m : {0.01, 0.01}) {
    for (CalibrationFrame& frame : camera().frames) sim::add_noise(deviation_m, 1, frame.depth_m);
    const double now_m = value_of(propose().self_filter, "tolerance_m");
    EXPECT_GT(now_m, before_m);
    EXPECT_LT(now_m, 0.11);
    EXPECT_NEAR(now_m * 100, std::round(now_m * 100), 1e-9) << "whole centimetres";
    before_m = now_m;
  }
}

TEST_F(FilterProposalOf, ThePaddingGrowsWithTheFlyingPixels) {
  double before_m = value_of(propose().self_filter, "padding_m");
  for (const int width_px : {8, 14}) {
    draw_flying_pixels(width_px);
    const double now_m = value_of(propose().self_filter, "padding_m");
    EXPECT_GT(now_m, before_m);
    EXPECT_LE(now_m, 0.10);
    before_m = now_m;
  }
}

TEST_F(FilterProposalOf, ABiasIsToldUnlessItIsCorrected) {
  for (CalibrationFrame& frame : camera().frames) {
    for (float& z_m : frame.depth_m.pixels()) z_m += 0.015F;
  }
  found_.cameras[0].depth.offset_m = -0.015;
  EXPECT_NEAR(propose().bias_m, 0.015, 1e-4);
  EXPECT_NEAR(propose({}, true).bias_m, 0, 1e-4);
}

TEST_F(FilterProposalOf, WhatOneFrameShowsNearTheArmIsLeftOver) {
  draw_blob(1, 4, 3);
  const FilterProposal found = propose();
  EXPECT_EQ(found.leftover_px, 12);
  EXPECT_EQ(found.largest_leftover_px, 12);
  EXPECT_EQ(value_of(found.sensor, "speckle_px"), 13);
  // A rule that the camera has already is not weakened.
  EXPECT_TRUE(propose({.speckle_px = 30}).sensor.empty());
}

TEST_F(FilterProposalOf, ALargeLeftoverIsNoSpeckle) {
  draw_blob(1, 8, 6);
  const FilterProposal found = propose();
  EXPECT_EQ(found.largest_leftover_px, 48);
  EXPECT_TRUE(found.sensor.empty()) << "a rule against it would drop fingers";
}

TEST_F(FilterProposalOf, AFrameWhoseJointsAreUnknownAtTheClockIsLeftOut) {
  draw_blob(1, 4, 3);
  // Beyond the samples for all frames: there is nothing to propose from.
  found_.cameras[0].clock_offset_s = 1000;
  const FilterProposal none = propose();
  EXPECT_TRUE(none.self_filter.empty());
  EXPECT_EQ(none.leftover_px, 0);
}

}  // namespace
}  // namespace berth
