#include "thesis/exact/exact.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include "thesis/exact/search.hpp"

namespace berth {
namespace {

using Clock = std::chrono::steady_clock;

/// What all links have in common.
struct Task {
  const ImageRequest& request;
  Metric metric;
  float range_m;
  /// A link is done once its answer is known to this.
  float tolerance_m;
};

/// The last answer's pair as it is in the new images; a pair at the range where it is no more.
ClosestPair first_guess(const Task& task, const LinkDistance& last, LinkId id) {
  const ClosestPair none = no_pair_within(task.range_m);
  const Pixel r = last.robot_pixel;
  const Pixel o = last.obstacle_pixel;
  const DepthView obstacle_m = task.request.obstacles.depth_m();
  const auto is_inside = [&](Pixel p) {
    return p.u >= 0 && p.v >= 0 && p.u < obstacle_m.width && p.v < obstacle_m.height;
  };
  if (!is_inside(r) || !is_inside(o) || task.request.robot.link_id(r.u, r.v) != id) return none;
  ClosestPair pair{0,
                   static_cast<float>(r.u),
                   static_cast<float>(r.v),
                   task.request.robot.depth_m(r.u, r.v),
                   static_cast<float>(o.u),
                   static_cast<float>(o.v),
                   obstacle_m(o.u, o.v)};
  pair.squared_m2 = squared_distance_m2(task.metric, pair.ru, pair.rv, pair.robot_depth_m, pair.ou,
                                        pair.ov, pair.obstacle_depth_m);
  return pair.squared_m2 < none.squared_m2 ? pair : none;
}

void start(const Task& task, const LinkDistances& last, ExactWorkspace& workspace) {
  workspace.links.resize(workspace.robot.links.size());
  workspace.order.resize(workspace.robot.nodes.size());
  int first_order = 0;
  for (std::size_t i = 0; i < workspace.links.size(); ++i) {
    const LinkDistance guess = i < last.links.size() ? last.links[i] : LinkDistance{};
    workspace.links[i] = {first_guess(task, guess, static_cast<LinkId>(i + 1)), 0,
                          workspace.robot.links[i].pixels == 0, 0, first_order};
    first_order += workspace.robot.links[i].node_count;
  }
}

/// Searches on for one link, from the best pair that it has.
void search_on(const Task& task, const SearchLimits& limits, ExactWorkspace& workspace,
               std::size_t i) {
  ExactWorkspace::LinkSearch& link = workspace.links[i];
  const bool is_late = limits.deadline != Clock::time_point::max() && link.best.ru >= 0 &&
                       link.lower_bound_m > 0 && Clock::now() >= limits.deadline;
  if (link.is_done || is_late) return;
  const SearchResult result = search_link(
      {task.metric, workspace.robot, task.request.robot.depth_m, task.request.obstacles.tree(),
       task.request.obstacles.depth_m(), workspace.order.data() + link.first_order},
      workspace.robot.links[i].last_node, limits, link.best);
  link.pairs += result.pairs;
  link.lower_bound_m = std::max(link.lower_bound_m, result.lower_bound_m);
  link.is_done = result.complete && limits.tolerance_m <= task.tolerance_m;
}

void search_all(const Task& task, const SearchLimits& limits, ExactWorkspace& workspace) {
  tbb::parallel_for(std::size_t{0}, workspace.links.size(),
                    [&](std::size_t i) { search_on(task, limits, workspace, i); });
}

/// Against a deadline: a search that is cut leaves bounds of all sizes behind, but one that ends
/// within a tolerance a bound near its answer. So what is not easy gets such a bound first.
void search_until(Clock::time_point begin, Clock::duration wait, const Task& task,
                  ExactWorkspace& workspace) {
  constexpr double kEasyPart = 0.3;
  constexpr float kFirstTolerance_m = 4e-3f;
  SearchLimits limits{task.tolerance_m};
  limits.deadline = begin + std::chrono::duration_cast<Clock::duration>(kEasyPart * wait);
  search_all(task, limits, workspace);
  limits.deadline = begin + wait;
  if (task.tolerance_m < kFirstTolerance_m) {
    search_all(task, {kFirstTolerance_m, limits.deadline, 0}, workspace);
  }
  search_all(task, limits, workspace);
}

LinkDistance answer_of(const Task& task, LinkId id, int robot_pixels,
                       const ExactWorkspace::LinkSearch& search) {
  LinkDistance link = link_distance(id, robot_pixels, task.metric, search.best, task.range_m);
  if (search.is_done && task.tolerance_m == 0) return link;
  if (link.status == LinkStatus::ok) {
    link.lower_bound_m = std::min(search.lower_bound_m, link.distance_m);
  } else if (!search.is_done) {
    link.status = LinkStatus::cut_short;
    link.lower_bound_m = std::min(search.lower_bound_m, task.range_m);
  }
  return link;
}

}  // namespace

// Not in exact_search.cpp: there a standard template would be instantiated for an instruction set,
// and the linker might keep that copy for all callers.
void sort_by_bound(ExactWorkspace::NodeOrder* order, int count) {
  std::sort(order, order + count,
            [](const auto& a, const auto& b) { return a.bound_m2 < b.bound_m2; });
}

void exact(const ImageRequest& request, ExactWorkspace& workspace, LinkDistances& out) {
  const Clock::time_point begin = Clock::now();
  const ImageDistanceSettings& settings = request.settings;
  validate(settings);
  assert(request.robot.depth_m.width() == request.obstacles.depth_m().width);
  assert(request.robot.depth_m.height() == request.obstacles.depth_m().height);
  const Task task{request, metric_of(request.camera), static_cast<float>(settings.range_m),
                  static_cast<float>(settings.tolerance_m.value_or(0))};
  build_robot_tiles(request.robot, request.link_count, workspace.robot);
  start(task, out, workspace);
  if (settings.deadline_us) {
    const std::chrono::duration<double, std::micro> wait(std::min(*settings.deadline_us, 1e12));
    search_until(begin, std::chrono::duration_cast<Clock::duration>(wait), task, workspace);
  } else {
    SearchLimits limits{task.tolerance_m};
    if (task.tolerance_m > 0) limits.most_work_unaligned /= 2;
    search_all(task, limits, workspace);
  }

  out.pairs = 0;
  out.links.resize(request.link_count);
  for (int i = 0; i < request.link_count; ++i) {
    out.pairs += workspace.links[i].pairs;
    out.links[i] = answer_of(task, static_cast<LinkId>(i + 1), workspace.robot.links[i].pixels,
                             workspace.links[i]);
  }
}

}  // namespace berth
