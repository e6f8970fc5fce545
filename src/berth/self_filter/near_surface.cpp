#include "berth/self_filter/near_surface.hpp"

#include <algorithm>
#include <utility>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/self_filter/near_surface.cpp"
#include "hwy/foreach_target.h"

#include "berth/self_filter/pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

template <class D>
HWY_INLINE hn::Mask<D> is_candidate(D d, const CandidatePixels& candidates, int u, int v) {
  const auto z = hn::LoadU(d, candidates.sensor_depth_m.row(v) + u);
  const auto in_range = hn::And(hn::Ge(z, hn::Set(d, candidates.range.min_m)),
                                hn::Le(z, hn::Set(d, candidates.range.max_m)));
  const auto fate = load_fate(d, candidates.fate.row(v) + u);
  return hn::And(in_range, has_fate(d, fate, PixelFate::obstacle));
}

template <class D>
HWY_INLINE hn::Vec<D> load_robot(D d, const RobotSurface& surface, int u, int v) {
  return load_link_depth(d, surface.robot.depth_m.row(v) + u, surface.robot.link_id.row(v) + u);
}

/// The boxes of a tile's columns, so that its rows need no look across the lanes.
static_assert(kPackSize == kTileWidth_px);

/// Extends the boxes of columns to the pixels of depth z where `holds`. The first is that of pixel
/// u.
template <class D>
HWY_INLINE void extend(D d, const RobotSurface& surface, int u, int v, hn::Vec<D> z,
                       hn::Mask<D> holds, BoxPack& columns, int first) {
  if (hn::AllFalse(d, holds)) return;
  const hn::Vec<D> p[3] = {hn::Mul(hn::LoadU(d, surface.ray_x + u), z),
                           hn::Mul(hn::Set(d, surface.ray_y[v]), z), z};
  for (int axis = 0; axis < 3; ++axis) {
    float* const low_m = columns.min_m[axis] + first;
    float* const high_m = columns.max_m[axis] + first;
    const auto low = hn::LoadU(d, low_m);
    const auto high = hn::LoadU(d, high_m);
    hn::StoreU(hn::IfThenElse(holds, hn::Min(low, p[axis]), low), d, low_m);
    hn::StoreU(hn::IfThenElse(holds, hn::Max(high, p[axis]), high), d, high_m);
  }
}

BoxC robot_box(const RobotSurface& surface, const PixelRect& pixels) {
  BoxPack columns;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for_pixels(pixels.u_begin, pixels.u_end, [&](auto d, int u) HWY_ATTR {
      const auto z = load_robot(d, surface, u, v);
      extend(d, surface, u, v, z, hn::Eq(z, z), columns, u - pixels.u_begin);
    });
  }
  return box_of_boxes(columns);
}

BoxC candidate_box(const RobotSurface& surface, const CandidatePixels& candidates,
                   const PixelRect& pixels) {
  BoxPack columns;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for_pixels(pixels.u_begin, pixels.u_end, [&](auto d, int u) HWY_ATTR {
      const auto z = hn::LoadU(d, candidates.sensor_depth_m.row(v) + u);
      extend(d, surface, u, v, z, is_candidate(d, candidates, u, v), columns, u - pixels.u_begin);
    });
  }
  return box_of_boxes(columns);
}

void mark_all(const CandidatePixels& candidates, const PixelRect& pixels,
              Image<std::uint8_t>& near) {
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for_pixels(pixels.u_begin, pixels.u_end, [&](auto d, int u) HWY_ATTR {
      const hn::Rebind<std::int32_t, decltype(d)> di;
      const hn::Rebind<std::uint8_t, decltype(d)> db;
      const auto one = choose(d, is_candidate(d, candidates, u, v), hn::Set(di, 1), hn::Zero(di));
      hn::StoreU(hn::DemoteTo(db, one), db, near.row(v) + u);
    });
  }
}

struct Point {
  float x_m[3];
};

HWY_INLINE bool may_be_near(const Point& p, const BoxC& box, float radius2_m2) {
  float least2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float least =
        std::max({0.0F, box.min_m[axis] - p.x_m[axis], p.x_m[axis] - box.max_m[axis]});
    least2 += least * least;
  }
  return least2 <= radius2_m2;
}

bool is_near(const RobotSurface& surface, const Point& p, const PixelRect& robot_pixels,
             float radius2_m2) {
  bool found = false;
  for (int v = robot_pixels.v_begin; v < robot_pixels.v_end && !found; ++v) {
    for_pixels(robot_pixels.u_begin, robot_pixels.u_end, [&](auto d, int u) HWY_ATTR {
      const auto z = load_robot(d, surface, u, v);
      const auto dx = hn::Sub(hn::Mul(hn::LoadU(d, surface.ray_x + u), z), hn::Set(d, p.x_m[0]));
      const auto dy = hn::Sub(hn::Mul(hn::Set(d, surface.ray_y[v]), z), hn::Set(d, p.x_m[1]));
      const auto dz = hn::Sub(z, hn::Set(d, p.x_m[2]));
      const auto distance2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      found |= !hn::AllFalse(d, hn::Le(distance2, hn::Set(d, radius2_m2)));
    });
  }
  return found;
}

/// A tile in which something is near goes to the front: it is so for the next pixel more often than
/// not.
bool is_near_any(const RobotSurface& surface, const Point& p, float radius2_m2,
                 std::vector<RobotTile>& tiles) {
  for (RobotTile& tile : tiles) {
    if (!may_be_near(p, tile.box, radius2_m2)) continue;
    if (!is_near(surface, p, tile.pixels, radius2_m2)) continue;
    std::swap(tile, tiles.front());
    return true;
  }
  return false;
}

bool mark_near_pixels(const RobotSurface& surface, const CandidatePixels& candidates,
                      const PixelRect& pixels, float radius2_m2, std::vector<RobotTile>& tiles,
                      Image<std::uint8_t>& near) {
  const DepthRange& range = candidates.range;
  bool some = false;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      const float z = candidates.sensor_depth_m(u, v);
      if (candidates.fate(u, v) != PixelFate::obstacle || z < range.min_m || z > range.max_m)
        continue;
      const Point p{{surface.ray_x[u] * z, surface.ray_y[v] * z, z}};
      if (!is_near_any(surface, p, radius2_m2, tiles)) continue;
      near(u, v) = 1;
      some = true;
    }
  }
  return some;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(robot_box);
HWY_EXPORT(candidate_box);
HWY_EXPORT(mark_all);
HWY_EXPORT(mark_near_pixels);

BoxC box_of_robot(const RobotSurface& surface, const PixelRect& pixels) {
  return HWY_DYNAMIC_DISPATCH(robot_box)(surface, pixels);
}

BoxC box_of_candidates(const RobotSurface& surface, const CandidatePixels& candidates,
                       const PixelRect& pixels) {
  return HWY_DYNAMIC_DISPATCH(candidate_box)(surface, candidates, pixels);
}

void mark_candidates(const CandidatePixels& candidates, const PixelRect& pixels,
                     Image<std::uint8_t>& near) {
  HWY_DYNAMIC_DISPATCH(mark_all)(candidates, pixels, near);
}

bool mark_near(const RobotSurface& surface, const CandidatePixels& candidates,
               const PixelRect& pixels, float radius2_m2, std::vector<RobotTile>& tiles,
               Image<std::uint8_t>& near) {
  return HWY_DYNAMIC_DISPATCH(mark_near_pixels)(surface, candidates, pixels, radius2_m2, tiles,
                                                near);
}

}  // namespace berth
#endif  // HWY_ONCE
