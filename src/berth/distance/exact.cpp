#include "berth/distance/exact.hpp"

#include <algorithm>
#include <cassert>

#include "berth/distance/exact_search.hpp"

namespace berth {

// Not in exact_search.cpp: there a standard template would be instantiated for an instruction set,
// and the linker might keep that copy for all callers.
void sort_by_bound(ExactWorkspace::NodeOrder* order, int count) {
  std::sort(order, order + count,
            [](const auto& a, const auto& b) { return a.bound_m2 < b.bound_m2; });
}

void exact(const Camera& camera, const RobotImage& robot, const ObstacleTree& obstacles,
           int link_count, const DistanceSettings& settings, ExactWorkspace& workspace,
           LinkDistances& out) {
  validate(settings);
  assert(robot.depth_m.width() == obstacles.width && robot.depth_m.height() == obstacles.height);
  const Metric metric = metric_of(camera);
  const auto range_m = static_cast<float>(settings.range_m);
  build_robot_tiles(robot, link_count, workspace.robot);
  workspace.order.resize(workspace.robot.nodes.size());

  out.pairs = 0;
  out.links.resize(link_count);
  for (int i = 0; i < link_count; ++i) {
    const RobotTiles::Link& link = workspace.robot.links[i];
    ClosestPair best = no_pair_within(range_m);
    if (link.pixels > 0) {
      out.pairs += search_link({metric, workspace.robot, obstacles, workspace.order.data()},
                               link.last_node, best);
    }
    out.links[i] = link_distance(static_cast<LinkId>(i + 1), link.pixels, metric, best, range_m);
  }
}

}  // namespace berth
