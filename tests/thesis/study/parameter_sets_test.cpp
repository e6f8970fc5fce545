// The parameters that are varied.
#include "thesis/study/parameter_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

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

}  // namespace
}  // namespace berth::lab
