#include "tests/thesis/answer.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/shared_gl.hpp"
#include "tests/thesis/plain_definition.hpp"

namespace berth::testing {

bool finds_the_closest(Method method) {
  return std::find(kExactMethods.begin(), kExactMethods.end(), method) != kExactMethods.end();
}

namespace {

double tolerance_m(double distance_m) { return 1e-5 * std::max(1.0, distance_m); }

void expect_own_pair(const LinkDistance& link, const sim::ImagePair& images) {
  const Pixel r = link.robot_pixel;
  const Pixel o = link.obstacle_pixel;
  ASSERT_EQ(images.robot.link_id(r.u, r.v), link.id);
  const double pair_m = plain_distance_m(images.camera, r, images.robot.depth_m(r.u, r.v), o,
                                         images.obstacle_depth_m(o.u, o.v));
  EXPECT_NEAR(link.distance_m, pair_m, tolerance_m(pair_m));
  const double points_m = (link.obstacle_point_C_m - link.robot_point_C_m).norm();
  EXPECT_NEAR(points_m, pair_m, tolerance_m(link.obstacle_point_C_m.norm()));
}

}  // namespace

void MethodTest::SetUp() {
  if (runs_on_opengl(GetParam()) && !shared_gl()) GTEST_SKIP() << why_no_gl();
}

void MethodTest::TearDown() {
  if (SharedGl* gl = shared_gl()) gl->context.check("this test");
}

void answer(Method method, const sim::ImagePair& images, DepthView obstacle_depth_m,
            const ImageDistanceSettings& settings, AnswerWorkspace& workspace, LinkDistances& out) {
  if (runs_on_opengl(method)) {
    shared_gl()->evaluator.evaluate(method,
                                    {images.camera, images.robot, images.link_count,
                                     SearchableDepth(obstacle_depth_m), settings},
                                    out);
    return;
  }
  workspace.obstacles.build(obstacle_depth_m);
  evaluate(method, {images.camera, images.robot, images.link_count, workspace.obstacles, settings},
           workspace.evaluate, out);
}

LinkDistances answer(Method method, const sim::ImagePair& images,
                     const ImageDistanceSettings& settings) {
  AnswerWorkspace workspace;
  LinkDistances out;
  answer(method, images, images.obstacle_depth_m, settings, workspace, out);
  return out;
}

LinkDistances answer(Method method, const sim::ImagePair& images, double range_m) {
  return answer(method, images, image_settings(range_m, false));
}

void expect_no_distance(const LinkDistance& link) {
  EXPECT_NE(link.status, LinkStatus::ok);
  EXPECT_TRUE(std::isnan(link.distance_m));
  EXPECT_EQ(link.robot_pixel, Pixel{});
  EXPECT_EQ(link.obstacle_pixel, Pixel{});
  EXPECT_TRUE(link.robot_point_C_m.array().isNaN().all());
  EXPECT_TRUE(link.obstacle_point_C_m.array().isNaN().all());
  EXPECT_TRUE(link.mean_direction_C.array().isNaN().all());
  EXPECT_EQ(link.mean_count, 0);
}

void expect_same_answer(const LinkDistances& expected, const LinkDistances& actual,
                        const sim::ImagePair& images) {
  ASSERT_EQ(expected.links.size(), actual.links.size());
  for (std::size_t i = 0; i < expected.links.size(); ++i) {
    SCOPED_TRACE("link " + std::to_string(i + 1));
    const LinkDistance& link = actual.links[i];
    EXPECT_EQ(link.id, i + 1);
    EXPECT_EQ(link.robot_pixels, expected.links[i].robot_pixels);
    ASSERT_EQ(link.status, expected.links[i].status);
    if (link.status != LinkStatus::ok) {
      expect_no_distance(link);
      continue;
    }
    EXPECT_NEAR(link.distance_m, expected.links[i].distance_m, tolerance_m(link.distance_m));
    expect_own_pair(link, images);
  }
}

void expect_possible_answer(const LinkDistances& truth, const LinkDistances& actual,
                            const sim::ImagePair& images) {
  ASSERT_EQ(truth.links.size(), actual.links.size());
  for (std::size_t i = 0; i < truth.links.size(); ++i) {
    SCOPED_TRACE("link " + std::to_string(i + 1));
    const LinkDistance& link = actual.links[i];
    const LinkDistance& true_link = truth.links[i];
    EXPECT_EQ(link.id, i + 1);
    EXPECT_EQ(link.robot_pixels, true_link.robot_pixels);
    if (link.status != LinkStatus::ok) {
      EXPECT_EQ(link.status,
                true_link.robot_pixels == 0 ? LinkStatus::not_visible : LinkStatus::none_in_range);
      expect_no_distance(link);
    } else {
      ASSERT_EQ(true_link.status, LinkStatus::ok);
      EXPECT_GE(link.distance_m, true_link.distance_m - tolerance_m(true_link.distance_m));
      expect_own_pair(link, images);
    }
    EXPECT_EQ(std::isnan(link.lower_bound_m), link.status == LinkStatus::not_visible);
    if (link.status != LinkStatus::not_visible) {
      EXPECT_EQ(link.lower_bound_m, 0);
    }
  }
}

void expect_answer_of(Method method, const LinkDistances& brute_force, const LinkDistances& actual,
                      const sim::ImagePair& images) {
  if (!finds_the_closest(method)) {
    expect_possible_answer(brute_force, actual, images);
  } else {
    expect_same_answer(brute_force, actual, images);
  }
}

void put_robot(sim::ImagePair& images, int u, int v, float depth_m, LinkId link) {
  images.robot.depth_m(u, v) = depth_m;
  images.robot.link_id(u, v) = link;
}

void put_obstacle(sim::ImagePair& images, PixelRect rect, float depth_m) {
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) images.obstacle_depth_m(u, v) = depth_m;
  }
}

std::string method_test_name(const ::testing::TestParamInfo<Method>& info) {
  return std::string(name_of(info.param));
}

}  // namespace berth::testing
