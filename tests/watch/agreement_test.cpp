#include "berth/watch/pose_watch.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <numeric>

#include "sim/random.hpp"

namespace berth {
namespace {

TEST(Agreement, TurnsAtTheKthOfTheLastN) {
  Agreement agreement(3, 4);
  const auto add = [&](bool verdict) {
    agreement.add(verdict);
    return agreement.state();
  };
  EXPECT_FALSE(add(true));
  EXPECT_FALSE(add(true));
  EXPECT_FALSE(add(false));
  EXPECT_TRUE(add(true)) << "three of four";
  EXPECT_TRUE(add(false)) << "two of four hold neither state, so it stays";
  EXPECT_TRUE(add(true));
  EXPECT_TRUE(add(false));
  EXPECT_FALSE(add(false)) << "three of four the other way";
}

TEST(Agreement, IsTheDefinitionOnRandomVerdicts) {
  for (const auto& [k, n] : {std::pair{1, 1}, {2, 3}, {10, 15}, {15, 15}, {8, 15}}) {
    sim::Random random(static_cast<std::uint32_t>(16 * n + k));
    Agreement agreement(k, n);
    std::deque<int> last(static_cast<std::size_t>(n), 0);
    bool state = false;
    int turns = 0;
    for (int i = 0; i < 3000; ++i) {
      const bool verdict = random.chance(i / 100 % 2 == 0 ? 0.15 : 0.85);
      agreement.add(verdict);
      last.pop_front();
      last.push_back(verdict);
      const int says_true = std::accumulate(last.begin(), last.end(), 0);
      const bool before = state;
      if (says_true >= k) state = true;
      if (n - says_true >= k) state = false;
      turns += state != before;
      ASSERT_EQ(agreement.state(), state) << k << " of " << n << ", verdict " << i;
    }
    EXPECT_GT(turns, 10);
  }
}

}  // namespace
}  // namespace berth
