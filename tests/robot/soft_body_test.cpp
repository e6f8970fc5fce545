#include "berth/robot/soft_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/robot/primitives.hpp"
#include "sim/random.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

Eigen::Vector3f point_in(const Eigen::Vector3d& half_m, sim::Random& random) {
  return Eigen::Vector3d(random(-1, 1) * half_m.x(), random(-1, 1) * half_m.y(),
                         random(-1, 1) * half_m.z())
      .cast<float>();
}

/// How far inside it is; negative outside.
double depth_in_box_m(const Eigen::Vector3f& p_m, const Eigen::Vector3d& half_m) {
  return (half_m - p_m.cast<double>().cwiseAbs()).minCoeff();
}

constexpr double kColumn_m = 0.005;

TEST(SoftBody, HoldsWhatItsMeshEncloses) {
  const Eigen::Vector3d half_m(0.11, 0.2, 0.031);
  const SoftBody box(0, make_box(2 * half_m));
  const SoftBody ball(0, make_sphere(0.2));
  sim::Random random(1);
  int inside = 0;
  for (int i = 0; i < thinned(20'000); ++i) {
    const Eigen::Vector3f p_m = point_in(1.2 * half_m, random);
    const double depth_m = depth_in_box_m(p_m, half_m);
    if (std::abs(depth_m) > kColumn_m) {
      EXPECT_EQ(box.contains(p_m), depth_m > 0) << p_m.transpose();
    }
    inside += depth_m > 0;
    const Eigen::Vector3f q_m = point_in(Eigen::Vector3d::Constant(0.24), random);
    // The ball has flat sides.
    if (q_m.norm() < 0.19F) {
      EXPECT_TRUE(ball.contains(q_m)) << q_m.transpose();
    }
    if (q_m.norm() > 0.21F) {
      EXPECT_FALSE(ball.contains(q_m)) << q_m.transpose();
    }
  }
  EXPECT_GT(inside, thinned(8'000));
}

TEST(SoftBody, MayHaveRoomInside) {
  TriangleMesh tube = make_sphere(0.2);
  tube.append(make_sphere(0.1), Eigen::Affine3d::Identity());
  const SoftBody body(0, tube);
  EXPECT_FALSE(body.contains({0.01F, 0.02F, 0.03F}));
  EXPECT_TRUE(body.contains({0.01F, 0.02F, 0.15F}));
}

TEST(SoftBody, LongOnesHaveWiderColumns) {
  const SoftBody body(0, make_cylinder(3, 0.4));
  EXPECT_TRUE(body.contains({2.9F, 0.3F, 0.1F}));
  EXPECT_FALSE(body.contains({2.9F, 0.9F, 0.1F}));
}

TEST(SoftBody, AMeshThatIsNotClosedIsRefused) {
  for (const TriangleMesh& closed : {make_box({0.1, 0.1, 0.1}), make_cylinder(0.1, 0.3)}) {
    for (std::size_t i = 0; i < closed.triangles.size(); ++i) {
      TriangleMesh open = closed;
      open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(i));
      EXPECT_THROW(SoftBody(0, open), std::invalid_argument) << i;
    }
  }
}

}  // namespace
}  // namespace berth
