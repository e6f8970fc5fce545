#include "berth/sensor/holes.hpp"

#include <tbb/parallel_for.h>

namespace berth {

void fill_holes(HolePolicy policy, const RobotImage& robot, ObstacleImage& out) {
  if (policy == HolePolicy::free) return;
  tbb::parallel_for(0, out.depth_m.height(), [&](int v) {
    for (int u = 0; u < out.depth_m.width(); ++u) {
      if (out.fate(u, v) != PixelFate::no_reading || robot.link_id(u, v) != kNoLink) continue;
      out.depth_m(u, v) = kHoleDepth_m;
      out.fate(u, v) = PixelFate::hole;
    }
  });
}

}  // namespace berth
