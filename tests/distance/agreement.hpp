// Whether two answers to one request contradict each other.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "berth/types/closest_pair.hpp"

namespace berth::testing {

/// Both have the truth between their bounds.
inline void expect_agree(const SpacePair& a, const SpacePair& b) {
  if (b.is_known()) {
    EXPECT_LE(a.lower_bound_m, b.distance_m);
  }
  if (a.is_known()) {
    EXPECT_LE(b.lower_bound_m, a.distance_m);
  }
}

inline void expect_agree(const std::vector<WholeLinkDistance>& a,
                         const std::vector<WholeLinkDistance>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_agree(a[i].occupied, b[i].occupied);
    expect_agree(a[i].nearest, b[i].nearest);
  }
}

}  // namespace berth::testing
