// What `exact` promises where it may end before it knows the answer: a bound below the true
// distance and a pair above it.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/random_images.hpp"
#include "tests/support/image_settings.hpp"
#include "tests/support/thinned.hpp"
#include "tests/thesis/exact/smooth_images.hpp"
#include "thesis/brute_force.hpp"
#include "thesis/exact/exact.hpp"

namespace berth::testing {
namespace {

LinkDistances ask(const sim::ImagePair& images, const ImageDistanceSettings& settings) {
  SearchableDepth obstacles;
  obstacles.build(images.obstacle_depth_m);
  ExactWorkspace workspace;
  LinkDistances out;
  exact({images.camera, images.robot, images.link_count, obstacles, settings}, workspace, out);
  return out;
}

LinkDistances truth(const sim::ImagePair& images, double range_m) {
  LinkDistances out;
  brute_force({images.camera, images.robot, images.link_count,
               SearchableDepth(images.obstacle_depth_m), image_settings(range_m)},
              out);
  return out;
}

/// Fails the test unless the truth lies between bound and distance, whatever the status.
void expect_certified(const LinkDistance& link, const LinkDistance& true_link, float range_m) {
  ASSERT_EQ(link.robot_pixels, true_link.robot_pixels);
  switch (link.status) {
    case LinkStatus::not_visible:
      EXPECT_EQ(true_link.status, LinkStatus::not_visible);
      EXPECT_TRUE(std::isnan(link.lower_bound_m));
      break;
    case LinkStatus::none_in_range:
      EXPECT_EQ(true_link.status, LinkStatus::none_in_range);
      EXPECT_EQ(link.lower_bound_m, range_m);
      break;
    case LinkStatus::ok:
      EXPECT_EQ(true_link.status, LinkStatus::ok);
      EXPECT_LE(link.lower_bound_m, true_link.distance_m);
      EXPECT_GE(link.distance_m, true_link.distance_m);
      EXPECT_GE(link.lower_bound_m, 0);
      break;
    case LinkStatus::cut_short:
      EXPECT_LE(link.lower_bound_m,
                true_link.status == LinkStatus::ok ? true_link.distance_m : range_m);
      EXPECT_GE(link.lower_bound_m, 0);
      EXPECT_TRUE(std::isnan(link.distance_m));
      EXPECT_EQ(link.robot_pixel, Pixel{});
      break;
    case LinkStatus::stale:
    case LinkStatus::not_seen:
    case LinkStatus::not_observed:
      ADD_FAILURE() << "the evaluators know of no time and no other camera";
      break;
  }
}

void expect_certified(const LinkDistances& found, const LinkDistances& true_links, float range_m) {
  ASSERT_EQ(found.links.size(), true_links.links.size());
  for (std::size_t i = 0; i < found.links.size(); ++i) {
    SCOPED_TRACE("link " + std::to_string(i + 1));
    expect_certified(found.links[i], true_links.links[i], range_m);
  }
}

std::vector<sim::ImagePair> all_kinds() {
  std::vector<sim::ImagePair> kinds = {tilted_plates(0.3, 120, 90), ball_in_shell(120, 90),
                                       bowl_in_shell(120, 90)};
  for (std::uint32_t seed = 0; seed < thinned(12u); ++seed)
    kinds.push_back(sim::random_images(seed, 130, 94, 5));
  return kinds;
}

TEST(Certified, WithinTheToleranceOfTheTruth) {
  for (const sim::ImagePair& images : all_kinds()) {
    const LinkDistances true_links = truth(images, 1.0);
    for (const double tolerance_m : {1e-6, 1e-4, 1e-3, 0.02, 5.0}) {
      SCOPED_TRACE(tolerance_m);
      const LinkDistances found = ask(images, image_settings(1.0, false, tolerance_m));
      expect_certified(found, true_links, 1.0f);
      for (const LinkDistance& link : found.links) {
        if (link.status != LinkStatus::ok) continue;
        EXPECT_LE(link.distance_m - link.lower_bound_m, tolerance_m * 1.0001 + 1e-6);
      }
    }
  }
}

/// From no time at all to more than enough.
TEST(Certified, AtEveryDeadline) {
  for (const sim::ImagePair& images : all_kinds()) {
    const LinkDistances true_links = truth(images, 1.0);
    for (double deadline_us = 0; deadline_us < 4000; deadline_us = deadline_us * 1.3 + 2) {
      SCOPED_TRACE(deadline_us);
      expect_certified(ask(images, image_settings(1.0, false, 0, deadline_us)), true_links, 1.0f);
      expect_certified(ask(images, image_settings(1.0, false, 1e-3, deadline_us)), true_links,
                       1.0f);
    }
  }
}

TEST(Certified, AtEveryRangeAndDeadline) {
  const sim::ImagePair images = sim::random_images(3, 130, 94, 5);
  for (const float range_m : {0.01f, 0.1f, 0.3f, 0.6f}) {
    const LinkDistances true_links = truth(images, range_m);
    for (double deadline_us = 0; deadline_us < 1000; deadline_us = deadline_us * 1.5 + 3) {
      expect_certified(ask(images, image_settings(range_m, false, 0, deadline_us)), true_links,
                       range_m);
    }
  }
}

TEST(Certified, WithTimeEnoughTheAnswerIsExact) {
  for (const sim::ImagePair& images : all_kinds()) {
    const LinkDistances true_links = truth(images, 1.0);
    for (const double deadline_us : {1e7, 1e30}) {
      const LinkDistances found = ask(images, image_settings(1.0, false, 0, deadline_us));
      for (std::size_t i = 0; i < found.links.size(); ++i) {
        ASSERT_EQ(found.links[i].status, true_links.links[i].status);
        if (found.links[i].status != LinkStatus::ok) continue;
        EXPECT_EQ(found.links[i].distance_m, true_links.links[i].distance_m);
        EXPECT_EQ(found.links[i].lower_bound_m, true_links.links[i].distance_m);
      }
    }
  }
}

TEST(Certified, WithNoTimeAtAllThereIsStillAPairAndABound) {
  const sim::ImagePair images = tilted_plates(0.3, 320, 240);
  const LinkDistance link = ask(images, image_settings(1.0, false, 0, 0.0)).links[0];
  EXPECT_EQ(link.status, LinkStatus::ok);
  EXPECT_LT(link.distance_m, 1);
  EXPECT_GT(link.lower_bound_m, 0);
}

TEST(Certified, AToleranceSavesWorkWhereAllPairsTie) {
  const sim::ImagePair images = tilted_plates(0.3, 320, 240);
  EXPECT_LT(ask(images, image_settings(1.0, false, 1e-3)).pairs,
            ask(images, image_settings(1.0, false)).pairs);
}

TEST(Certified, ContactIsKnownAtOnce) {
  sim::ImagePair images = sim::random_images(4, 130, 94, 5);
  images.obstacle_depth_m = images.robot.depth_m;
  for (const LinkDistance& link : ask(images, image_settings(1.0, false, 0.01)).links) {
    if (link.status == LinkStatus::not_visible) continue;
    EXPECT_EQ(link.distance_m, 0);
    EXPECT_EQ(link.lower_bound_m, 0);
  }
}

}  // namespace
}  // namespace berth::testing
