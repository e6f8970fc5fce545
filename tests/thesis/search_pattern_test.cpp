#include "thesis/search_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace berth {
namespace {

struct VisitCase {
  Pixel robot;
  PixelStep step;
  PixelRect rect;
};

std::vector<VisitCase> all_cases() {
  std::vector<VisitCase> cases;
  for (const PixelRect rect :
       {PixelRect{0, 0, 1, 1}, {0, 0, 23, 17}, {4, 2, 23, 9}, {5, 0, 6, 17}, {0, 3, 23, 4}}) {
    const Pixel last{rect.u_end - 1, rect.v_end - 1};
    const Pixel middle{(rect.u_begin + last.u) / 2, (rect.v_begin + last.v) / 2};
    for (const Pixel robot : {Pixel{rect.u_begin, rect.v_begin}, last, middle}) {
      for (const PixelStep step : {PixelStep{1, 1}, {3, 2}, {1, 5}, {40, 40}, {65536, 1}}) {
        cases.push_back({robot, step, rect});
      }
    }
  }
  return cases;
}

std::vector<Pixel> visited(SearchPattern pattern, const VisitCase& c) {
  std::vector<Pixel> pixels;
  visit_runs(pattern, c.robot, c.step, c.rect, [&](const PixelRun& run) {
    for (int i = 0; i < run.count; ++i) pixels.push_back({run.u + i * run.du, run.v + i * run.dv});
  });
  return pixels;
}

class Pattern : public ::testing::TestWithParam<SearchPattern> {};
INSTANTIATE_TEST_SUITE_P(SearchPatterns, Pattern, ::testing::ValuesIn(kSearchPatterns),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

TEST_P(Pattern, VisitsEachStepOfTheRegionOnceAndNothingElse) {
  for (const VisitCase& c : all_cases()) {
    std::map<std::pair<int, int>, int> times;
    for (const Pixel p : visited(GetParam(), c)) ++times[{p.u, p.v}];
    std::size_t expected = 0;
    for (int v = c.rect.v_begin; v < c.rect.v_end; ++v) {
      for (int u = c.rect.u_begin; u < c.rect.u_end; ++u) {
        if ((u - c.robot.u) % c.step.x != 0 || (v - c.robot.v) % c.step.y != 0) continue;
        ++expected;
        EXPECT_EQ((times[{u, v}]), 1) << u << " " << v;
      }
    }
    EXPECT_EQ(times.size(), expected);
  }
}

/// The rectangle loses a border after each run, as a region does that shrinks.
TEST_P(Pattern, AlwaysVisitsWhatARegionThatShrinksKeepsToTheEnd) {
  for (const PixelStep step : {PixelStep{1, 1}, {2, 3}}) {
    const Pixel robot{20, 15};
    PixelRect rect{0, 0, 40, 30};
    const PixelRect kept{14, 11, 27, 20};
    std::map<std::pair<int, int>, int> times;
    visit_runs(GetParam(), robot, step, rect, [&](const PixelRun& run) {
      for (int i = 0; i < run.count; ++i) {
        const Pixel p{run.u + i * run.du, run.v + i * run.dv};
        EXPECT_TRUE(p.u >= rect.u_begin && p.u < rect.u_end);
        EXPECT_TRUE(p.v >= rect.v_begin && p.v < rect.v_end);
        ++times[{p.u, p.v}];
      }
      rect = {std::min(rect.u_begin + 1, kept.u_begin), std::min(rect.v_begin + 2, kept.v_begin),
              std::max(rect.u_end - 2, kept.u_end), std::max(rect.v_end - 1, kept.v_end)};
    });
    for (int v = kept.v_begin; v < kept.v_end; ++v) {
      for (int u = kept.u_begin; u < kept.u_end; ++u) {
        const bool is_step = (u - robot.u) % step.x == 0 && (v - robot.v) % step.y == 0;
        EXPECT_EQ((times[{u, v}]), is_step ? 1 : 0) << u << " " << v;
      }
    }
  }
}

const VisitCase kPlainCase{{8, 5}, {2, 1}, {0, 0, 23, 17}};

TEST(RowMajor, GoesFromTopToBottom) {
  int last = 0;
  for (const Pixel p : visited(SearchPattern::row_major, kPlainCase)) {
    EXPECT_GE(p.v, last);
    last = p.v;
  }
}

TEST(Oscillating, GoesAwayFromTheRobotsRow) {
  int last = 0;
  for (const Pixel p : visited(SearchPattern::oscillating, kPlainCase)) {
    EXPECT_GE(std::abs(p.v - kPlainCase.robot.v), last);
    last = std::abs(p.v - kPlainCase.robot.v);
  }
}

TEST(Spiral, GoesAwayFromTheRobotRingByRing) {
  int last = 0;
  for (const Pixel p : visited(SearchPattern::spiral, kPlainCase)) {
    const int ring =
        std::max(std::abs(p.u - kPlainCase.robot.u) / 2, std::abs(p.v - kPlainCase.robot.v));
    EXPECT_GE(ring, last);
    last = ring;
  }
}

}  // namespace
}  // namespace berth
