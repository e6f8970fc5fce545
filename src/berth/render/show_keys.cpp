#include "berth/render/draw_triangles.hpp"

#include <algorithm>
#include <utility>

// Compiles the rest of this file once for each instruction set: its loops are the compiler's to
// make vectors of.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/render/show_keys.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// Moves the keys of one canvas into those of another.
void move_keys(PixelKey* from, int count, PixelKey* to) {
  for (int i = 0; i < count; ++i) {
    to[i] = std::max(to[i], from[i]);
    from[i] = 0;
  }
}

void show(PixelKey* keys, int count, float* depth_m, LinkId* id) {
  for (int i = 0; i < count; ++i) {
    const float inverse_depth = inverse_depth_of(keys[i]);
    const float z_m = 1 / inverse_depth;
    depth_m[i] = inverse_depth == 0 ? kNoDepth : z_m;
    id[i] = inverse_depth == 0 ? kNoLink : id_of(keys[i]);
    keys[i] = 0;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(move_keys);
HWY_EXPORT(show);

namespace {

void clear(RobotImage& image, int v, int u_begin, int u_end) {
  if (u_begin >= u_end) return;
  std::fill(image.depth_m.row(v) + u_begin, image.depth_m.row(v) + u_end, kNoDepth);
  std::fill(image.link_id.row(v) + u_begin, image.link_id.row(v) + u_end, kNoLink);
}

void show_keys(std::span<Canvas> canvases, int v, int u_begin, int u_end, RobotImage& image) {
  PixelKey* const keys = canvases.front().keys.row(v) + u_begin;
  const int count = u_end - u_begin;
  for (Canvas& other : canvases.subspan(1)) {
    if (!other.used) continue;
    HWY_DYNAMIC_DISPATCH(move_keys)(other.keys.row(v) + u_begin, count, keys);
  }
  HWY_DYNAMIC_DISPATCH(show)
  (keys, count, image.depth_m.row(v) + u_begin, image.link_id.row(v) + u_begin);
}

/// The columns of a rectangle in one row.
std::pair<int, int> columns(const PixelRect& rect, int v) {
  const bool has_row = !rect.empty() && v >= rect.v_begin && v < rect.v_end;
  return has_row ? std::pair(rect.u_begin, rect.u_end) : std::pair(0, 0);
}

}  // namespace

void show_row(std::span<Canvas> canvases, int v, const PixelRect& extent, const PixelRect& before,
              RobotImage& image) {
  const auto [u_begin, u_end] = columns(extent, v);
  const auto [before_begin, before_end] = columns(before, v);
  clear(image, v, before_begin, std::min(before_end, u_begin));
  clear(image, v, std::max(before_begin, u_end), before_end);
  if (u_begin < u_end) show_keys(canvases, v, u_begin, u_end, image);
}

}  // namespace berth
#endif  // HWY_ONCE
