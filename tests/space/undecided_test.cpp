// Flying patches that another view frees by a rule alone stay unknown.
#include "berth/space/unknown_space.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace berth {
namespace {

/// A patch of 5 x 5 pixels, 1 m before the first camera; a second one looks at it from the right,
/// from 1 m away as well.
class Undecided : public ::testing::Test {
 protected:
  /// The second camera reads this all over, and takes it for `fate`.
  bool ask(float second_reads_m, PixelFate fate, double age_s = 0) {
    fill(0, 3, PixelFate::obstacle);
    for (int v = 28; v < 33; ++v) {
      for (int u = 38; u < 43; ++u) {
        depth_m_[0](u, v) = 1;
        images_[0].fate(u, v) = PixelFate::flying_patch;
        images_[0].depth_m(u, v) = kNoDepth;
      }
    }
    fill(1, second_reads_m, fate);
    std::array<PosedSpace, 2> posed{PosedSpace{&spaces_[0], Pose::Identity(), 0},
                                    PosedSpace{&spaces_[1], Pose::Identity(), age_s}};
    posed[1].X_BC.linear() = Eigen::AngleAxisd(-1.5707963, Eigen::Vector3d::UnitY()).matrix();
    posed[1].X_BC.translation() = Eigen::Vector3d(1, 0, 1);
    for (int k = 0; k < 2; ++k) {
      build_camera_space(camera_, depth_m_[k], images_[k], {}, {}, spaces_[k]);
    }
    UnknownSpace space;
    space.assign(posed);
    return find_undecided(space.views(), 0, images_[0].fate, found_m_);
  }

  void fill(int k, float reads_m, PixelFate fate) {
    depth_m_[k] = DepthImage(camera_.width_px, camera_.height_px, reads_m);
    images_[k].fate = Image<PixelFate>(camera_.width_px, camera_.height_px, fate);
    images_[k].depth_m = fate == PixelFate::obstacle
                             ? depth_m_[k]
                             : DepthImage(camera_.width_px, camera_.height_px, kNoDepth);
  }

  Camera camera_{80, 60, 60, 60, 39.5, 29.5};
  std::array<DepthImage, 2> depth_m_;
  std::array<ObstacleImage, 2> images_;
  std::array<CameraSpace, 2> spaces_;
  DepthImage found_m_;
};

TEST_F(Undecided, WhatAnotherViewSeesThroughIsNot) {
  EXPECT_FALSE(ask(3, PixelFate::obstacle));
  EXPECT_FALSE(ask(3, PixelFate::robot)) << "in front of the robot";
}

TEST_F(Undecided, WhatLiesBehindTheRobotForTheOtherViewIs) {
  EXPECT_TRUE(ask(0.9F, PixelFate::robot));
  EXPECT_NEAR(found_m_(40, 30), 1, 1e-3);
  EXPECT_TRUE(std::isnan(found_m_(37, 30)));
  EXPECT_TRUE(ask(0.9F, PixelFate::padding));
}

TEST_F(Undecided, WhatNoViewFreesIsUnknownAnyway) {
  EXPECT_FALSE(ask(0.9F, PixelFate::obstacle));
  EXPECT_FALSE(ask(kNoDepth, PixelFate::no_reading));
  EXPECT_FALSE(ask(0.9F, PixelFate::robot, 1)) << "too old to free anything";
}

}  // namespace
}  // namespace berth
