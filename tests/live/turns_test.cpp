#include "berth/live/turns.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <thread>
#include <vector>

namespace berth {
namespace {

TEST(Turns, GoInTheOrderInWhichTheyWereAskedFor) {
  Turns turns(1);
  std::vector<std::int64_t> expected(20), order;
  std::iota(expected.begin(), expected.end(), 0);
  for (const std::int64_t place : expected) EXPECT_EQ(turns.ask(), place);
  {
    std::vector<std::jthread> threads;
    for (std::int64_t place = 19; place >= 0; --place) {
      threads.emplace_back([&, place] {
        EXPECT_TRUE(turns.wait(place, {}));
        order.push_back(place);
        turns.give_back();
      });
    }
  }
  EXPECT_EQ(order, expected);
}

TEST(Turns, SoManyWorkAtATime) {
  constexpr int kAtATime = 3;
  Turns turns(kAtATime);
  std::atomic<int> at_work = 0, most = 0;
  std::atomic<int> of_three = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&] {
        for (int round = 0; round < 50; ++round) {
          EXPECT_TRUE(turns.wait(turns.ask(), {}));
          const int now = ++at_work;
          for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
          // The first three wait for each other: they must work at the same time.
          if (++of_three <= kAtATime) {
            while (of_three < kAtATime) std::this_thread::yield();
          }
          --at_work;
          turns.give_back();
        }
      });
    }
  }
  EXPECT_EQ(most, kAtATime);
}

TEST(Turns, WhoStopsWaitingHoldsNobodyUp) {
  Turns turns(1);
  const std::int64_t first = turns.ask(), second = turns.ask(), third = turns.ask();
  EXPECT_TRUE(turns.wait(first, {}));
  std::stop_source stop;
  std::jthread waiting([&] { EXPECT_FALSE(turns.wait(second, stop.get_token())); });
  stop.request_stop();
  waiting.join();
  turns.give_back();
  EXPECT_TRUE(turns.wait(third, {}));
  turns.give_back();
}

}  // namespace
}  // namespace berth
