#include "berth/sensor/holes.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

namespace berth {

void fill_holes(HolePolicy policy, const RobotImage& robot, HoleWorkspace& workspace,
                ObstacleImage& out) {
  if (policy == HolePolicy::free) return;
  const bool asks_neighbour = policy == HolePolicy::nearest_neighbour;
  if (asks_neighbour) find_nearest_depth(out.depth_m, workspace.nearest, workspace.nearest_m);
  tbb::parallel_for(0, out.depth_m.height(), [&](int v) {
    for (int u = 0; u < out.depth_m.width(); ++u) {
      if (out.fate(u, v) != PixelFate::no_reading || robot.link_id(u, v) != kNoLink) continue;
      const float depth_m = asks_neighbour ? workspace.nearest_m(u, v) : kHoleDepth_m;
      if (std::isnan(depth_m)) continue;
      out.depth_m(u, v) = depth_m;
      out.fate(u, v) = PixelFate::hole;
    }
  });
}

}  // namespace berth
