#include "berth/self_filter/drop_soft.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/robot/primitives.hpp"
#include "sim/random.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

/// A column of SoftBody.
constexpr double kColumn_m = 0.005;

class DropSoft : public ::testing::Test {
 protected:
  /// Readings at depths that are drawn, some of which a rule has dropped already.
  ObstacleImage image(std::uint32_t seed) const {
    sim::Random random(seed);
    ObstacleImage out;
    out.depth_m.resize(camera_.width_px, camera_.height_px, kNoDepth);
    out.fate.resize(camera_.width_px, camera_.height_px, PixelFate::robot);
    for (int v = 0; v < camera_.height_px; ++v) {
      for (int u = 0; u < camera_.width_px; ++u) {
        if (random.chance(0.7)) {
          out.fate(u, v) = PixelFate::obstacle;
          out.depth_m(u, v) = static_cast<float>(random(0.2, 2));
        }
        ++out.count[static_cast<std::size_t>(out.fate(u, v))];
      }
    }
    return out;
  }

  Camera camera_{64, 48, 50, 50, 31.5, 23.5};
  RobotPose pose_{{Pose::Identity(), Pose(Eigen::Translation3d(0.1, -0.2, 1))}};
};

TEST_F(DropSoft, DropsKeptReadingsInItAndNoOthers) {
  sim::Random random(3);
  for (int i = 0; i < thinned(200); ++i) {
    const Eigen::Vector3d center_B(random(-1, 1), random(-1, 1), random(-0.3, 1.5));
    pose_.X_BL[1].translation() = center_B;
    const Pose X_BC(Eigen::AngleAxisd(random(-1, 1), Eigen::Vector3d::UnitY()));
    const double radius_m = random(0.1, 0.5);
    const SoftBody ball(1, make_sphere(radius_m));
    const ObstacleImage before = image(static_cast<std::uint32_t>(i));
    ObstacleImage after = before;
    drop_soft(camera_, {{&ball, pose_.X_BL[1].inverse() * X_BC}}, after);
    std::array<std::int64_t, kPixelFateCount> count{};
    for (int v = 0; v < camera_.height_px; ++v) {
      for (int u = 0; u < camera_.width_px; ++u) {
        const PixelFate fate = after.fate(u, v);
        ++count[static_cast<std::size_t>(fate)];
        if (fate == PixelFate::soft) {
          EXPECT_TRUE(std::isnan(after.depth_m(u, v)));
        } else {
          EXPECT_EQ(fate, before.fate(u, v));
        }
        if (before.fate(u, v) != PixelFate::obstacle) continue;
        const Eigen::Vector3d p_B_m = X_BC * point_at(camera_, u, v, before.depth_m(u, v));
        const double off_m = (p_B_m - center_B).norm();
        if (off_m < 0.95 * radius_m - kColumn_m) {
          EXPECT_EQ(fate, PixelFate::soft);
        }
        if (off_m > radius_m + kColumn_m) {
          EXPECT_EQ(fate, PixelFate::obstacle);
        }
      }
    }
    EXPECT_EQ(count, after.count);
  }
}

}  // namespace
}  // namespace berth
