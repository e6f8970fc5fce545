#include "berth/watch/seen_through.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace berth {
namespace {

double share(int part, int all) {
  return all > 0 ? static_cast<double>(part) / all : std::numeric_limits<double>::quiet_NaN();
}

/// Every Nth row, whole: next to each other, pixels cost less than on a grid of points, since
/// memory comes in lines of 16.
int row_step(const PixelRect& rect) {
  const std::int64_t pixels = std::int64_t{rect.u_end - rect.u_begin} * (rect.v_end - rect.v_begin);
  return static_cast<int>((pixels + kMostReadPixels - 1) / kMostReadPixels);
}

/// Without branches, so that the compiler makes vector code of it.
void read_row(const float* reading_m, const float* model_m, const LinkId* id, int begin, int end,
              float bias_m, RobotReadings& found) {
  int at_surface = 0, close = 0, behind = 0, before = 0, hidden = 0, robot = 0;
  for (int u = begin; u < end; ++u) {
    const int is_robot = (id[u] != kNoLink) & (id[u] != kEnvironmentLink);
    const float behind_m = reading_m[u] - model_m[u] - bias_m;
    robot += is_robot;
    behind += is_robot & static_cast<int>(behind_m > kSeenThrough_m);
    at_surface += is_robot & static_cast<int>(std::abs(behind_m) <= kSeenThrough_m);
    close += is_robot & static_cast<int>(std::abs(behind_m) <= kClose_m);
    before += is_robot & static_cast<int>(behind_m < -kSeenThrough_m);
    hidden += is_robot & static_cast<int>(behind_m < -kHidden_m);
  }
  found.at_surface += at_surface;
  found.close += close;
  found.behind += behind;
  found.before += before - hidden;
  found.hidden += hidden;
  found.none += robot - at_surface - behind - before;
}

/// visit(row, first column, one behind the last).
template <class Visit>
void visit_rows(DepthView depth_m, const RobotImage& robot, const Visit& visit) {
  const PixelRect rect = clip(robot.extent, depth_m.width, depth_m.height);
  if (rect.empty()) return;
  const int step = row_step(rect);
  for (int v = rect.v_begin + step / 2; v < rect.v_end; v += step) {
    visit(v, rect.u_begin, rect.u_end);
  }
}

}  // namespace

double RobotReadings::seen_through() const { return share(behind, judged()); }

double RobotReadings::at_robot() const { return share(at_surface, judged()); }

bool RobotReadings::tells() const {
  return judged() >= kLeastJudgedPixels && hidden_share() <= kMostHiddenForSeenThrough;
}

bool RobotReadings::is_hidden() const {
  return hidden >= kLeastJudgedPixels && hidden_share() > kMostHiddenForSeenThrough;
}

double RobotReadings::hidden_share() const {
  return share(hidden, hidden + before + at_surface + behind);
}

RobotReadings& RobotReadings::operator+=(const RobotReadings& more) {
  at_surface += more.at_surface;
  close += more.close;
  behind += more.behind;
  before += more.before;
  hidden += more.hidden;
  none += more.none;
  return *this;
}

void read_links(DepthView depth_m, const RobotImage& robot, double bias_m,
                std::span<RobotReadings> of_link) {
  visit_rows(depth_m, robot, [&](int v, int begin, int end) {
    const LinkId* const ids = robot.link_id.row(v);
    for (int u = begin; u < end; ++u) {
      if (ids[u] == kNoLink || ids[u] == kEnvironmentLink) continue;
      read_row(depth_m.row(v), robot.depth_m.row(v), ids, u, u + 1, static_cast<float>(bias_m),
               of_link[ids[u] - 1U]);
    }
  });
}

RobotReadings read_robot(DepthView depth_m, const RobotImage& robot, double bias_m) {
  RobotReadings found;
  visit_rows(depth_m, robot, [&](int v, int begin, int end) {
    read_row(depth_m.row(v), robot.depth_m.row(v), robot.link_id.row(v), begin, end,
             static_cast<float>(bias_m), found);
  });
  return found;
}

}  // namespace berth
