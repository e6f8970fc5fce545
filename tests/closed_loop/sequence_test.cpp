// What berth reports on an arm and people that move, instant by instant.
#include "lab/closed_loop/sequence.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace berth::lab {
namespace {

using Instants = std::vector<SequenceInstant>;

bool is_falsely_zero(const SequenceLink& link) { return link.told_m < 0.001 && link.true_m > 0.05; }

std::size_t instants_with_a_false_zero(const Instants& instants) {
  return static_cast<std::size_t>(std::ranges::count_if(instants, [](const SequenceInstant& links) {
    return std::ranges::any_of(links, is_falsely_zero);
  }));
}

double most_too_large_m(const Instants& instants) {
  double most_m = 0;
  for (const SequenceInstant& instant : instants) {
    for (const SequenceLink& link : instant) {
      const bool is_seen = link.sight == sim::ObstacleSight::covered;
      if (is_seen) most_m = std::max(most_m, link.told_m - link.true_m);
    }
  }
  return most_m;
}

TEST(Sequence, DarkOutlinesHideNothingFromThreeCamerasThatDetectFourCentimetres) {
  SpaceSettings no_closing;
  no_closing.detection_capability_m = 0;
  const std::vector<SequenceCondition> conditions = {
      {"dark", sim::kDarkErrors, {}, 3}, {"and every hole hides", sim::kDarkErrors, no_closing, 3}};
  const auto instants = run_sequence(100, conditions, {.every_s = 0.6});
  ASSERT_GE(instants[0].size(), 8u);
  EXPECT_EQ(instants[0].size(), instants[1].size());
  for (const SequenceInstant& instant : instants[0]) EXPECT_EQ(instant.size(), 7u);
  EXPECT_LE(instants_with_a_false_zero(instants[0]), 2u) << "of " << instants[0].size();
  EXPECT_GT(instants_with_a_false_zero(instants[1]), instants_with_a_false_zero(instants[0]));
  EXPECT_LT(most_too_large_m(instants[0]), 0.06);
  const std::string table = sequence_table(conditions, instants);
  EXPECT_NE(table.find("| dark, 3 cameras | "), std::string::npos) << table;
}

}  // namespace
}  // namespace berth::lab
