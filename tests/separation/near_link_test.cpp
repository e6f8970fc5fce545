// Unknown distances count as near, by their policy.
#include "berth/separation/near_link.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace berth {
namespace {

constexpr double kRange_m = 2;
using enum UnknownPolicy;

LinkResult near_thing_at(float distance_m) {
  LinkResult link;
  link.id = 1;
  link.status = LinkStatus::ok;
  link.distance_m = link.occupied.distance_m = distance_m;
  link.lower_bound_m = link.occupied.lower_bound_m = distance_m - 0.001F;
  link.camera = link.occupied.camera = 0;
  return link;
}

LinkVisibility seen(float share) {
  LinkVisibility visibility;
  visibility.surface.seen = share;
  return visibility;
}

NearLink near_of(LinkResult link, const SeparationSettings& settings = {},
                 const LinkVisibility& visibility = seen(0.8F)) {
  link.visibility = visibility;
  return near_link(settings, link, kRange_m);
}

void expect_near(const NearLink& near, double distance_m, SeparationReason reason) {
  EXPECT_FLOAT_EQ(static_cast<float>(near.distance_m), static_cast<float>(distance_m));
  EXPECT_EQ(name_of(near.reason), name_of(reason));
}

TEST(NearLink, WhatIsCertifiedCounts) {
  expect_near(near_of(near_thing_at(0.5F)), 0.499, SeparationReason::occupied);
}

TEST(NearLink, WhereNothingIsInRangeTheRangeCounts) {
  LinkResult link;
  link.status = LinkStatus::none_in_range;
  link.lower_bound_m = kRange_m;
  expect_near(near_of(link), kRange_m, SeparationReason::range);
}

TEST(NearLink, WhatADeadlineCutCountsByItsBound) {
  LinkResult link = near_thing_at(0.9F);
  link.status = LinkStatus::cut_short;
  link.lower_bound_m = 0.2F;
  expect_near(near_of(link), 0.2, SeparationReason::cut_short);
}

TEST(NearLink, AStaleOneStops) {
  LinkResult link;
  link.status = LinkStatus::stale;
  SeparationSettings all_ignored;
  all_ignored.not_seen = all_ignored.unknown = all_ignored.rejected = all_ignored.camera = ignore;
  expect_near(near_of(link, all_ignored), 0, SeparationReason::stale);
}

TEST(NearLink, UnknownSpaceGoesByItsPolicy) {
  LinkResult link = near_thing_at(0.8F);
  link.obstacle_is = ObstacleKind::unknown;
  link.distance_m = 0.3F;
  link.lower_bound_m = 0.299F;
  SeparationSettings settings;
  expect_near(near_of(link, settings), 0.299, SeparationReason::unknown);
  settings.unknown = stop;
  expect_near(near_of(link, settings), 0, SeparationReason::unknown);
  settings.unknown = ignore;
  expect_near(near_of(link, settings), 0.799, SeparationReason::occupied);
  link.occupied = SpacePair();
  link.occupied.lower_bound_m = kRange_m;
  expect_near(near_of(link, settings), kRange_m, SeparationReason::range);
}

TEST(NearLink, WhatIsInNoImageGoesByThePolicyOfUnknownSpace) {
  LinkResult link = near_thing_at(0.3F);
  link.obstacle_is = ObstacleKind::unobserved;
  link.occupied = near_thing_at(0.8F).occupied;
  SeparationSettings settings;
  expect_near(near_of(link, settings), 0.299, SeparationReason::unobserved);
  settings.unknown = ignore;
  expect_near(near_of(link, settings), 0.799, SeparationReason::occupied);
}

TEST(NearLink, ALinkThatIsNotObservedHasSomethingAtTheAssumedRange) {
  LinkResult link = near_thing_at(0.8F);
  link.status = LinkStatus::not_observed;
  SeparationSettings settings;
  settings.assumed_range_m = 0.4;
  expect_near(near_of(link, settings), 0.4, SeparationReason::unobserved);
  settings.unknown = stop;
  expect_near(near_of(link, settings), 0, SeparationReason::unobserved);
  settings.unknown = ignore;
  expect_near(near_of(link, settings), 0.799, SeparationReason::occupied);
}

TEST(NearLink, ALinkThatIsNotSeenEnoughGoesByItsPolicy) {
  LinkResult not_seen = near_thing_at(0.8F);
  not_seen.status = LinkStatus::not_seen;
  for (const auto& [link, visibility] :
       {std::pair{not_seen, seen(0.01F)}, std::pair{near_thing_at(0.8F), seen(0.1F)}}) {
    SeparationSettings settings;
    expect_near(near_of(link, settings, visibility), 0, SeparationReason::not_seen);
    settings.not_seen = assume_range;
    settings.assumed_range_m = 0.4;
    expect_near(near_of(link, settings, visibility), 0.4, SeparationReason::not_seen);
    settings.assumed_range_m = 1;
    expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::occupied);
    settings.not_seen = ignore;
    expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::occupied);
  }
}

TEST(NearLink, ALinkWithoutABoundIsFreeOnlyWhereThatIsIgnored) {
  LinkResult link;
  link.status = LinkStatus::not_visible;
  link.lower_bound_m = link.occupied.lower_bound_m = std::numeric_limits<float>::quiet_NaN();
  SeparationSettings settings;
  expect_near(near_of(link, settings, LinkVisibility()), 0, SeparationReason::not_seen);
  settings.not_seen = ignore;
  expect_near(near_of(link, settings, LinkVisibility()), kRange_m, SeparationReason::range);
}

TEST(NearLink, LeastSeenIsASetting) {
  SeparationSettings settings;
  settings.least_seen = 0.9;
  expect_near(near_of(near_thing_at(0.8F), settings), 0, SeparationReason::not_seen);
}

TEST(NearLink, RejectedReadingsGoByTheirPolicy) {
  LinkVisibility visibility = seen(0.8F);
  visibility.rejected_distance_m = 0.1F;
  SeparationSettings settings;
  const LinkResult link = near_thing_at(0.8F);
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::occupied);
  settings.rejected = assume_range;
  expect_near(near_of(link, settings, visibility), 0.1, SeparationReason::rejected);
  settings.rejected = stop;
  expect_near(near_of(link, settings, visibility), 0, SeparationReason::rejected);
  settings.rejected = ignore;
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::occupied);
  visibility.rejected_distance_m = 0.9F;
  settings.rejected = stop;
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::occupied);
}

}  // namespace
}  // namespace berth
