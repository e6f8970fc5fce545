// The parameters that are varied.
#include "thesis/study/parameter_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "thesis/study/errors.hpp"

namespace berth::lab {
namespace {

TEST(ParameterSets, AreTheThesiss2200) {
  EXPECT_EQ(sets_of(Part::parameters, full_extent()).size(), 2200u);
  EXPECT_EQ(sets_of(Part::every_pair, full_extent()).size(), 2200u);
}

TEST(ParameterSets, HaveStepsUpTo32AndTheThesissRadii) {
  for (const ParameterSet& set : sets_of(Part::parameters, full_extent())) {
    EXPECT_LE(set.settings.lattice.step_x, 32);
    EXPECT_LE(set.settings.lattice.step_y, 32);
  }
  const auto has = [](int initial_px, int final_px) {
    const auto sets = sets_of(Part::parameters, full_extent());
    return std::any_of(sets.begin(), sets.end(), [&](const ParameterSet& set) {
      return set.settings.lattice.initial_grid_radius_px == initial_px &&
             set.settings.lattice.final_grid_radius_px == final_px;
    });
  };
  for (const int final_px : {1, 2, 3}) EXPECT_TRUE(has(40, final_px) && has(100, final_px));
}

TEST(ParameterSets, AreAllValidAndDifferByTheirColumns) {
  for (const SweepExtent& extent : {full_extent(), quick_extent()}) {
    std::set<std::string> columns;
    std::size_t count = 0;
    for (const Part part : kParts) {
      for (const ParameterSet& set : sets_of(part, extent)) {
        validate(set.settings);
        columns.insert(columns_of(set));
        ++count;
      }
    }
    EXPECT_EQ(columns.size(), count);
  }
}

TEST(ParameterSets, HaveAsManyColumnsAsTheirHeader) {
  const auto commas = std::count(kSetColumns.begin(), kSetColumns.end(), ',');
  for (const Part part : kParts) {
    const std::string columns = columns_of(sets_of(part, quick_extent()).front());
    EXPECT_EQ(std::count(columns.begin(), columns.end(), ','), commas) << columns;
  }
}

TEST(ParameterSets, OfTheQuickStudyAreAmongTheFullOnes) {
  for (const Part part : kParts) {
    std::set<std::string> full;
    for (const ParameterSet& set : sets_of(part, full_extent())) full.insert(columns_of(set));
    for (const ParameterSet& set : sets_of(part, quick_extent())) {
      EXPECT_TRUE(full.contains(columns_of(set))) << columns_of(set);
    }
  }
}

// Errors against brute force, on answers made by hand.

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
