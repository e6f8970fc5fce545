// What lies in no image, where SpaceSettings::unobserved says that this is unknown.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <list>

#include "berth/space/unknown_space.hpp"
#include "sim/random.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

/// Two cameras at right angles that read 9 m in each pixel: all that is before that is free.
class UnobservedSpace : public ::testing::Test {
 protected:
  UnobservedSpace() {
    const DepthImage depth_m(camera_.width_px, camera_.height_px, 9);
    ObstacleImage obstacles;
    obstacles.depth_m = depth_m;
    obstacles.fate = Image<PixelFate>(camera_.width_px, camera_.height_px, PixelFate::obstacle);
    settings_.unobserved = Unobserved::unknown;
    for (CameraSpace& space : spaces_) {
      build_camera_space(camera_, depth_m, obstacles_.emplace_back(obstacles), {}, settings_,
                         space);
    }
    posed_ = {{&spaces_[0], Pose::Identity(), 0}, {&spaces_[1], Pose::Identity(), 0}};
    posed_[1].X_BC.linear() = Eigen::AngleAxisd(1.5708, Eigen::Vector3d::UnitY()).matrix();
    posed_[1].X_BC.translation() = Eigen::Vector3d(-2, 0, 2);
  }

  /// By hand: x / z and y / z within the image's borders.
  bool is_in_image(std::size_t k, const Eigen::Vector3d& p_B) const {
    const Eigen::Vector3d p = posed_[k].X_BC.inverse() * p_B;
    return p.z() > 0 && std::abs(p.x() / p.z()) < 40.0 / 60 && std::abs(p.y() / p.z()) < 30.0 / 60;
  }

  Camera camera_{80, 60, 60, 60, 39.5, 29.5};
  SpaceSettings settings_;
  std::list<ObstacleImage> obstacles_;
  std::array<CameraSpace, 2> spaces_;
  std::vector<PosedSpace> posed_;
};

TEST_F(UnobservedSpace, IsWhatNoImageHasAndNoGuardedBox) {
  GuardedBox box;
  box.X_BG =
      Eigen::Translation3d(0, 2, 2) * Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized());
  box.half_m = {1.5, 0.6, 0.9};
  UnknownSpace space;
  space.assign(posed_, nullptr, {&box, 1});
  EXPECT_FALSE(space.is_shadow());
  sim::Random random(3);
  int outside = 0, guarded = 0, empty = 0;
  for (int i = 0; i < thinned(20000); ++i) {
    const Eigen::Vector3d p_B(random(-3, 3), random(-3, 3), random(-1, 5));
    const Eigen::Vector3d in_box = (box.X_BG.inverse() * p_B).cwiseAbs() - box.half_m;
    const bool is_outside = !is_in_image(0, p_B) && !is_in_image(1, p_B);
    const bool is_unobserved = is_outside && in_box.maxCoeff() > 0;
    const auto hiding = space.hiding_pixel(p_B);
    ASSERT_EQ(hiding.has_value(), is_unobserved) << p_B.transpose();
    if (hiding) {
      EXPECT_EQ(hiding->pixel, (Pixel{-1, -1}));
    }
    outside += is_outside;
    guarded += is_outside && !is_unobserved;
    const int level = random.whole(1, mesh::Cube::kTopLevel);
    const auto at = [&](int of_level) {
      const double edge_m = mesh::Cube{of_level, 0, 0, 0}.edge_m();
      const Eigen::Vector3i place = ((p_B.array() - mesh::Cube::kCorner_m) / edge_m).cast<int>();
      return mesh::Cube{of_level, place.x(), place.y(), place.z()};
    };
    const mesh::Cube child = at(level - 1);
    const int place = child.x % 4 + child.y % 4 * 4 + child.z % 4 * 16;
    const bool is_possible = space.block(at(level)) >> place & 1;
    ASSERT_TRUE(is_possible || !is_unobserved) << "level " << level;
    empty += !is_possible;
  }
  EXPECT_GT(outside, thinned(5000));
  EXPECT_GT(guarded, thinned(200));
  EXPECT_GT(empty, thinned(2000));
}

TEST_F(UnobservedSpace, IsNothingUnlessTheSettingsSaySo) {
  for (CameraSpace& space : spaces_) space.settings.unobserved = Unobserved::ignore;
  UnknownSpace space;
  space.assign(posed_);
  EXPECT_FALSE(space.hiding_pixel({0, 3, 0}));
}

/// An image that is too old shows nothing any more.
TEST_F(UnobservedSpace, GrowsWithWhatIsTooOld) {
  UnknownSpace space;
  space.assign(posed_);
  EXPECT_FALSE(space.hiding_pixel({0, 0, 4}));
  posed_[0].age_s = 1;
  posed_[1].age_s = 1;
  space.assign(posed_);
  EXPECT_TRUE(space.hiding_pixel({0, 0, 4}));
}

}  // namespace
}  // namespace berth
