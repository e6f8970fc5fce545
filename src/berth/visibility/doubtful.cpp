#include "berth/visibility/doubtful.hpp"

#include <algorithm>
#include <cassert>

namespace berth {
namespace {

bool is_doubtful(PixelFate fate) { return fate == PixelFate::island || fate == PixelFate::speckle; }

void add(Pixel p, PixelRect& extent) {
  if (extent.empty()) {
    extent = {p.u, p.v, p.u + 1, p.v + 1};
    return;
  }
  extent = {std::min(extent.u_begin, p.u), std::min(extent.v_begin, p.v),
            std::max(extent.u_end, p.u + 1), std::max(extent.v_end, p.v + 1)};
}

}  // namespace

void clear_doubtful(int width, int height, DoubtfulImage& out) {
  if (out.depth_m.width() != width || out.depth_m.height() != height) {
    out.depth_m.resize(width, height, kNoDepth);
  } else {
    // Faster than all pixels.
    for (int v = out.extent.v_begin; v < out.extent.v_end; ++v) {
      std::fill(out.depth_m.row(v) + out.extent.u_begin, out.depth_m.row(v) + out.extent.u_end,
                kNoDepth);
    }
  }
  out.extent = {};
}

void find_doubtful(DepthView sensor_depth_m, const ObstacleImage& obstacles, DoubtfulImage& out) {
  const int width = sensor_depth_m.width, height = sensor_depth_m.height;
  assert(obstacles.fate.width() == width && obstacles.fate.height() == height);
  clear_doubtful(width, height, out);
  if (obstacles.count_of(PixelFate::island) + obstacles.count_of(PixelFate::speckle) == 0) return;
  for (int v = 0; v < height; ++v) {
    const PixelFate* fate = obstacles.fate.row(v);
    // Most rows have none, and counting goes in vectors.
    if (std::count_if(fate, fate + width, is_doubtful) == 0) continue;
    for (int u = 0; u < width; ++u) {
      if (!is_doubtful(fate[u])) continue;
      out.depth_m(u, v) = sensor_depth_m(u, v);
      add({u, v}, out.extent);
    }
  }
}

void find_doubtful_distances(const Camera& camera, const RobotImage& robot,
                             const DoubtfulImage& doubtful, const LinkDistances& distances,
                             double range_m, DoubtfulWorkspace& workspace,
                             std::vector<LinkVisibility>& out) {
  assert(out.size() == distances.links.size());
  const bool has_any = !doubtful.extent.empty();
  if (has_any) {
    exact({camera, robot, static_cast<int>(out.size()), doubtful.searchable, {.range_m = range_m}},
          workspace.exact, workspace.distances);
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].doubtful_distance_m = std::numeric_limits<float>::quiet_NaN();
    out[i].doubtful_pixel = {};
    if (!has_any || workspace.distances.links[i].status != LinkStatus::ok) continue;
    const LinkDistance& kept = distances.links[i];
    const LinkDistance& dropped = workspace.distances.links[i];
    if (kept.status == LinkStatus::ok && kept.distance_m <= dropped.distance_m) continue;
    out[i].doubtful_distance_m = dropped.distance_m;
    out[i].doubtful_pixel = dropped.obstacle_pixel;
  }
}

}  // namespace berth
