// What is not known counts as near, by its policy.
#include "berth/separation/near_link.hpp"

#include <gtest/gtest.h>

namespace berth {
namespace {

constexpr double kRange_m = 2;
using enum UnknownPolicy;

LinkDistance near_reading_at(float distance_m) {
  LinkDistance link;
  link.id = 1;
  link.status = LinkStatus::ok;
  link.distance_m = link.reading.distance_m = distance_m;
  link.lower_bound_m = link.reading.lower_bound_m = distance_m - 0.001F;
  link.reading.view = 0;
  return link;
}

LinkVisibility seen(float share) {
  LinkVisibility visibility;
  visibility.surface.seen = share;
  return visibility;
}

NearLink near_of(const LinkDistance& link, const SeparationSettings& settings = {},
                 const LinkVisibility& visibility = seen(0.8F)) {
  return near_link(settings, link, visibility, kRange_m);
}

void expect_near(const NearLink& near, double distance_m, SeparationReason reason) {
  EXPECT_FLOAT_EQ(static_cast<float>(near.distance_m), static_cast<float>(distance_m));
  EXPECT_EQ(name_of(near.reason), name_of(reason));
}

TEST(NearLink, WhatIsCertifiedCounts) {
  expect_near(near_of(near_reading_at(0.5F)), 0.499, SeparationReason::reading);
}

TEST(NearLink, WhereNothingIsInRangeTheRangeCounts) {
  LinkDistance link;
  link.status = LinkStatus::none_in_range;
  link.lower_bound_m = kRange_m;
  expect_near(near_of(link), kRange_m, SeparationReason::range);
}

TEST(NearLink, WhatADeadlineCutCountsByItsBound) {
  LinkDistance link = near_reading_at(0.9F);
  link.status = LinkStatus::cut_short;
  link.lower_bound_m = 0.2F;
  expect_near(near_of(link), 0.2, SeparationReason::cut_short);
}

TEST(NearLink, AnUntimelyOneStops) {
  LinkDistance link;
  link.status = LinkStatus::untimely;
  SeparationSettings all_ignored;
  all_ignored.not_seen = all_ignored.hidden = all_ignored.doubtful = all_ignored.camera = ignore;
  expect_near(near_of(link, all_ignored), 0, SeparationReason::untimely);
}

TEST(NearLink, HiddenSpaceGoesByItsPolicy) {
  LinkDistance link = near_reading_at(0.8F);
  link.obstacle_kind = ObstacleKind::hidden;
  link.distance_m = 0.3F;
  link.lower_bound_m = 0.299F;
  SeparationSettings settings;
  expect_near(near_of(link, settings), 0.299, SeparationReason::hidden);
  settings.hidden = stop;
  expect_near(near_of(link, settings), 0, SeparationReason::hidden);
  settings.hidden = ignore;
  expect_near(near_of(link, settings), 0.799, SeparationReason::reading);
  link.reading = {};
  link.reading.lower_bound_m = kRange_m;
  expect_near(near_of(link, settings), kRange_m, SeparationReason::range);
}

TEST(NearLink, ALinkThatIsNotSeenEnoughGoesByItsPolicy) {
  LinkDistance not_seen = near_reading_at(0.8F);
  not_seen.status = LinkStatus::not_seen;
  for (const auto& [link, visibility] :
       {std::pair{not_seen, seen(0.01F)}, std::pair{near_reading_at(0.8F), seen(0.1F)}}) {
    SeparationSettings settings;
    expect_near(near_of(link, settings, visibility), 0, SeparationReason::not_seen);
    settings.not_seen = assume_range;
    settings.assumed_range_m = 0.4;
    expect_near(near_of(link, settings, visibility), 0.4, SeparationReason::not_seen);
    settings.assumed_range_m = 1;
    expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::reading);
    settings.not_seen = ignore;
    expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::reading);
  }
}

TEST(NearLink, ALinkWithoutABoundIsFreeOnlyWhereThatIsIgnored) {
  LinkDistance link;
  link.status = LinkStatus::not_visible;
  SeparationSettings settings;
  expect_near(near_of(link, settings, LinkVisibility()), 0, SeparationReason::not_seen);
  settings.not_seen = ignore;
  expect_near(near_of(link, settings, LinkVisibility()), kRange_m, SeparationReason::range);
}

TEST(NearLink, LeastSeenIsASetting) {
  SeparationSettings settings;
  settings.least_seen = 0.9;
  expect_near(near_of(near_reading_at(0.8F), settings), 0, SeparationReason::not_seen);
}

TEST(NearLink, DoubtfulReadingsGoByTheirPolicy) {
  LinkVisibility visibility = seen(0.8F);
  visibility.doubtful_distance_m = 0.1F;
  SeparationSettings settings;
  const LinkDistance link = near_reading_at(0.8F);
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::reading);
  settings.doubtful = assume_range;
  expect_near(near_of(link, settings, visibility), 0.1, SeparationReason::doubtful);
  settings.doubtful = stop;
  expect_near(near_of(link, settings, visibility), 0, SeparationReason::doubtful);
  settings.doubtful = ignore;
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::reading);
  visibility.doubtful_distance_m = 0.9F;
  settings.doubtful = stop;
  expect_near(near_of(link, settings, visibility), 0.799, SeparationReason::reading);
}

}  // namespace
}  // namespace berth
