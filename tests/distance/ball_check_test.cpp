// The vector code of many configurations against what the field says of single places.
#include "berth/distance/ball_check.hpp"

#include <gtest/gtest.h>

#include "tests/support/field_bounds.hpp"
#include "tests/support/mesh_world.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

/// A ball of this radius that three slides put anywhere.
mesh::BallRobot sliding_ball(float radius_m) {
  mesh::BallRobot robot;
  robot.joint_count = 3;
  for (int k = 0; k < 3; ++k) {
    mesh::BallFrame frame;
    frame.parent = k - 1;
    frame.joint = k;
    frame.is_slide = true;
    frame.of_none.setIdentity();
    frame.of_cos.setZero();
    frame.of_sin.setZero();
    frame.at_m.setZero();
    frame.slide = frame.axis = Eigen::Vector3f::Unit(k);
    robot.frames.push_back(frame);
  }
  mesh::BallLink link{1, 2, {}};
  link.balls.coarse.set(0, Eigen::Vector3f::Zero(), radius_m);
  link.balls.fine[0].set(0, Eigen::Vector3f::Zero(), radius_m);
  link.balls.radius_m = radius_m;
  for (std::size_t i = 0; i < 8; ++i) {
    link.balls.coarse_points[0].set(i, Eigen::Vector3f::Zero(), 0);
    link.balls.fine_points[0][0].set(i, Eigen::Vector3f::Zero(), 0);
  }
  robot.links.push_back(link);
  return robot;
}

TEST(BallCheck, IsWhatTheFieldSaysOfThePlace) {
  constexpr float kMargin_m = 0.03f, kRadius_m = 0.01f, kSlack_m = 3e-4f;
  const mesh::BallRobot robot = sliding_ball(kRadius_m);
  const std::vector<float> margins_m{kMargin_m};
  const mesh::FirstLinkBounds none;
  sim::Random random(1);
  int free = 0, near = 0;
  for (std::uint32_t seed = 0; seed < thinned(8u); ++seed) {
    MeshWorldSettings settings;
    settings.views = 1 + static_cast<int>(seed % 3);
    const MeshWorld world = draw_mesh_world(settings, 700 + seed);
    const PreparedWorld prepared(world);
    ClearanceField field;
    field.build(prepared.space(), UnknownSpace(), Eigen::Vector3d::Zero(), 0.5);
    const mesh::BallRequest request{robot, field.grid(), margins_m, none};
    for (int i = 0; i < 4000; ++i) {
      const Eigen::Vector3d p_B = sim::draw_point(random, 0.6);
      const std::array<double, 3> position{p_B.x(), p_B.y(), p_B.z()};
      Verdict verdict{};
      mesh::check_configurations(request, position, {&verdict, 1});
      const double lower_m = lower_bound_m(field.grid(), p_B) - kRadius_m;
      ASSERT_TRUE(verdict != Verdict::free || lower_m > kMargin_m - kSlack_m) << p_B.transpose();
      ASSERT_TRUE(verdict == Verdict::free || lower_m < kMargin_m + kSlack_m) << p_B.transpose();
      ASSERT_TRUE(verdict != Verdict::near ||
                  upper_bound_m(field.grid(), p_B) < kMargin_m + kSlack_m);
      free += verdict == Verdict::free;
      near += verdict == Verdict::near;
    }
  }
  EXPECT_GT(free, 0);
  EXPECT_GT(near, 0);
}

TEST(BallCheck, AMotionThatIsFreeIsSoAtEachOfItsPlaces) {
  const mesh::BallRobot robot = sliding_ball(0.005f);
  const std::vector<float> margins_m{0.02f};
  const mesh::FirstLinkBounds none;
  const MeshWorld world = draw_mesh_world({}, 711);
  const PreparedWorld prepared(world);
  ClearanceField field;
  field.build(prepared.space(), UnknownSpace(), Eigen::Vector3d::Zero(), 0.5);
  const mesh::BallRequest request{robot, field.grid(), margins_m, none};
  sim::Random random(2);
  int free = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from = sim::draw_point(random, 0.28), to = sim::draw_point(random, 0.28);
    const std::array<double, 3> first{from.x(), from.y(), from.z()}, last{to.x(), to.y(), to.z()};
    if (mesh::check_motion(request, first, last, 0.002f) != Verdict::free) continue;
    ++free;
    for (int k = 0; k <= 100; ++k) {
      const Eigen::Vector3d p_B = from + (to - from) * k / 100;
      ASSERT_GT(lower_bound_m(field.grid(), p_B), 0.02f + 0.005f - 3e-4f) << p_B.transpose();
    }
  }
  EXPECT_GT(free, 10);
}

}  // namespace
}  // namespace berth::testing
