// Errors against brute force, on answers made by hand.
#include "thesis/study/errors.hpp"

#include <gtest/gtest.h>

namespace berth::lab {
namespace {

LinkDistance link(float distance_m, Eigen::Vector3f robot_C_m, Eigen::Vector3f obstacle_C_m) {
  LinkDistance link;
  link.status = LinkStatus::ok;
  link.distance_m = distance_m;
  link.robot_point_C_m = robot_C_m;
  link.obstacle_point_C_m = obstacle_C_m;
  return link;
}

LinkDistance without_pair(LinkStatus status) {
  LinkDistance link;
  link.status = status;
  return link;
}

TEST(Errors, AreTheDifferencesOfDistancesAndPointsInMillimetres) {
  const LinkDistances truth{
      {link(0.2f, {0, 0, 1}, {0.2f, 0, 1}), link(0.5f, {0, 1, 1}, {0, 1, 1.5f})}};
  const LinkDistances found{
      {link(0.21f, {0, 0.03f, 1.04f}, {0.2f, 0, 1}), link(0.53f, {0, 1, 1}, {0, 1, 1.53f})}};
  const LinkErrors errors = errors_of(truth, found, 1.0);
  EXPECT_EQ(errors.links_in_range, 2);
  EXPECT_EQ(errors.links_missed, 0);
  EXPECT_NEAR(errors.distance_mm.mean(), 20, 1e-3);
  EXPECT_NEAR(errors.distance_mm.deviation(), 10, 1e-3);
  EXPECT_NEAR(errors.distance_mm.greatest, 30, 1e-3);
  EXPECT_NEAR(errors.robot_point_mm.mean(), 25, 1e-3);
  EXPECT_NEAR(errors.robot_point_mm.greatest, 50, 1e-3);
  EXPECT_NEAR(errors.obstacle_point_mm.mean(), 15, 1e-3);
}

TEST(Errors, LinksThatWereNotFoundAreCountedAndHaveNoError) {
  const LinkDistance near = link(0.2f, {0, 0, 1}, {0.2f, 0, 1});
  const LinkDistances truth{{near, near, near}};
  const LinkDistances found{
      {without_pair(LinkStatus::none_in_range), near, without_pair(LinkStatus::cut_short)}};
  const LinkErrors errors = errors_of(truth, found, 1.0);
  EXPECT_EQ(errors.links_in_range, 3);
  EXPECT_EQ(errors.links_missed, 2);
  EXPECT_EQ(errors.distance_mm.count, 1);
  EXPECT_EQ(errors.distance_mm.mean(), 0);
}

TEST(Errors, OnlyLinksInRangeOfTheRequestCount) {
  const LinkDistances truth{
      {link(0.5f, {0, 0, 1}, {0.5f, 0, 1}), link(0.7f, {0, 0, 1}, {0.7f, 0, 1}),
       without_pair(LinkStatus::none_in_range), without_pair(LinkStatus::not_visible)}};
  const LinkDistances found{{truth.links[0], without_pair(LinkStatus::none_in_range),
                             without_pair(LinkStatus::none_in_range),
                             without_pair(LinkStatus::not_visible)}};
  const LinkErrors errors = errors_of(truth, found, 0.5);
  EXPECT_EQ(errors.links_in_range, 1);
  EXPECT_EQ(errors.links_missed, 0);
}

}  // namespace
}  // namespace berth::lab
