#include "thesis/lattice/link_pixels.hpp"

#include <cassert>
#include <numeric>

namespace berth {
namespace {

template <class Visit>
void visit_robot_pixels(const RobotImage& robot, Visit visit) {
  const PixelRect rect = clip(robot.extent, robot.link_id.width(), robot.link_id.height());
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    const LinkId* ids = robot.link_id.row(v);
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      if (ids[u] != kNoLink && ids[u] != kEnvironmentLink) visit(ids[u], Pixel{u, v});
    }
  }
}

}  // namespace

void LinkPixels::sort(const RobotImage& robot, int link_count) {
  first_.assign(link_count + 2, 0);
  visit_robot_pixels(robot, [&](LinkId id, Pixel) {
    assert(id <= link_count);
    ++first_[id + 1];
  });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  pixels_.resize(first_.back());
  // Moves first_[id] from where the id's pixels begin to where they end, which is where those of
  // link number id begin.
  visit_robot_pixels(robot, [&](LinkId id, Pixel p) { pixels_[first_[id]++] = p; });
}

}  // namespace berth
