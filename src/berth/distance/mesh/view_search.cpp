#include <algorithm>
#include <cmath>
#include <cstring>

#include "berth/distance/mesh/link_search.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mesh/view_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mesh/leaf-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// A view as one link's search sees it.
struct LinkView {
  const ViewSpace* space;
  SearchFrame frame;
  /// Pixel border u, at u - 1/2, has the slope x / z = u per_column + first_column.
  float per_column, first_column, per_row, first_row;
  /// Behind it is nothing within the range.
  float far_m;
};

LinkView make_view(const CarvingView& view, const LinkSearch& search) {
  const Camera& camera = view.space->camera;
  const Pose X_CL = view.X_CB * search.X_BL;
  const PatchLevel& top = search.link->levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double radius_m = top.half_height_m[0] + top.radius_m[0];
  const double reach_m = centre_L_m.norm() + X_CL.translation().norm() + radius_m + search.range_m;
  LinkView out;
  out.space = view.space;
  out.frame = make_frame(X_CL, static_cast<float>(reach_m));
  out.per_column = static_cast<float>(1 / camera.fx_px);
  out.first_column = static_cast<float>((-0.5 - camera.cx_px) / camera.fx_px);
  out.per_row = static_cast<float>(1 / camera.fy_px);
  out.first_row = static_cast<float>((-0.5 - camera.cy_px) / camera.fy_px);
  out.far_m = static_cast<float>((X_CL * centre_L_m).z() + radius_m + search.range_m);
  return out;
}

struct Chunk {
  float a0, a1, b0, b1, d, e;
};

struct ViewSearch {
  LinkSearch& link;
  bool to_shadow;
  LinkView views[HiddenSpace::kMostViews];
};

HWY_INLINE float end_of(const ViewSearch& search, const LinkView& view, float hi_m) {
  if (search.to_shadow) return view.far_m;
  return std::min(hi_m + static_cast<float>(view.space->settings.slab_m), view.far_m);
}

Chunk chunk_of(const ViewSearch& search, const ImageCell& cell) {
  const LinkView& view = search.views[cell.view];
  const DepthCells& cells = view.space->cells;
  float lo_m = HUGE_VALF;
  float hi_m = -HUGE_VALF;
  int side_px = 1;
  if (cell.level == ImageCell::kPixelLevel) {
    lo_m = hi_m = view.space->obstacle_depth_m(cell.u, cell.v);
  } else if (cell.level == cells.level_count) {
    side_px = 4 * cells.levels[cell.level - 1].cell_px;
    const DepthCells::Node& node = cells.levels[cell.level - 1].nodes[0];
    for (int half = 0; half < 2; ++half) {
      for (int i = 0; i < DepthCells::kChildren; ++i) {
        lo_m = std::min(lo_m, node.lo_m[half][i]);
        hi_m = std::max(hi_m, node.hi_m[half][i]);
      }
    }
  } else {
    const DepthCells::Level& level = cells.levels[cell.level];
    const DepthCells::Node& node = level.nodes[cell.v / 4 * level.node_columns + cell.u / 4];
    side_px = level.cell_px;
    lo_m = node.lo_m[cell.half][cell.v % 4 * 4 + cell.u % 4];
    hi_m = node.hi_m[cell.half][cell.v % 4 * 4 + cell.u % 4];
  }
  const auto u = static_cast<float>(cell.u * side_px);
  const auto v = static_cast<float>(cell.v * side_px);
  const auto side = static_cast<float>(side_px);
  return {u * view.per_column + view.first_column,
          (u + side) * view.per_column + view.first_column,
          v * view.per_row + view.first_row,
          (v + side) * view.per_row + view.first_row,
          lo_m,
          end_of(search, view, hi_m)};
}

HWY_INLINE Chunks broadcast(const Chunk& c) {
  return {Lanes(c.a0), Lanes(c.a1), Lanes(c.b0), Lanes(c.b1), Lanes(c.d), Lanes(c.e)};
}

/// The leaf's triangles against one pixel; returns from where they came nearest.
Heading search_pixel(ViewSearch& search, int leaf, const ImageCell& pixel) {
  const LinkView& view = search.views[pixel.view];
  const Chunk c = chunk_of(search, pixel);
  if (!(c.d <= c.e)) return {};
  Eigen::Vector3d corners_m[8];
  for (int i = 0; i < 8; ++i) {
    const double z = i & 4 ? c.e : c.d;
    corners_m[i] = {z * (i & 1 ? c.a1 : c.a0), z * (i & 2 ? c.b1 : c.b0), z};
  }
  return search_leaf(search.link, view.frame, leaf, broadcast(c), corners_m,
                     [&](const Eigen::Vector3f&) {
                       search.link.best_pixel = pixel.key();
                       search.link.best_is_hidden = search.to_shadow;
                     });
}

/// 64 bounds of a patch and the pixels of a cell, +inf where there is nothing, and the pixels'
/// chunks.
struct PixelBounds {
  alignas(64) float m[64];
  alignas(64) float depth_m[64];
  alignas(64) float end_m[64];
};

/// The pixels i, i + 1, ... of a cell.
HWY_INLINE Chunks pixel_chunks(const LinkView& view, const ImageCell& cell, int i, Lanes depth,
                               Lanes end) {
  const Lanes place = count_up(static_cast<float>(i));
  const Lanes row = hn::Floor((place * Lanes(0.125f)).v);
  const Lanes u = place - row * Lanes(8.0f) + Lanes(static_cast<float>(8 * cell.u));
  const Lanes v = row + Lanes(static_cast<float>(8 * cell.v));
  const Lanes du(view.per_column), u0(view.first_column), dv(view.per_row), v0(view.first_row);
  return {u * du + u0, (u + Lanes(1.0f)) * du + u0, v * dv + v0, (v + Lanes(1.0f)) * dv + v0, depth,
          end};
}

/// What lies before a plane along n is bounded by it: where a pixel was nearest to a leaf, its
/// neighbours are about as near.
HWY_INLINE void bound_by_plane(const ViewSearch& search, int leaf, const ImageCell& cell,
                               const Heading& n, PixelBounds& bounds) {
  const LinkView& view = search.views[cell.view];
  const Lanes along(least_along(search.link, view.frame, leaf, n) - view.frame.error_m);
  for (int i = 0; i < 64; i += kLanes) {
    const Chunks chunks =
        pixel_chunks(view, cell, i, load(bounds.depth_m + i), load(bounds.end_m + i));
    store(greatest(load(bounds.m + i), along - reach_of(chunks, broadcast(n))), bounds.m + i);
  }
}

HWY_INLINE void bound_pixels(const ViewSearch& search, const Patches& patch, const ImageCell& cell,
                             const Chunk& parent, PixelBounds& out) {
  const LinkView& view = search.views[cell.view];
  const DepthImage& image_m = view.space->obstacle_depth_m;
  const float slab_m = static_cast<float>(view.space->settings.slab_m);
  alignas(64) float depth_m[64];
  const int u_begin = 8 * cell.u;
  const int v_begin = 8 * cell.v;
  const int width = std::min(8, image_m.width() - u_begin);
  const int height = std::min(8, image_m.height() - v_begin);
  if (width < 8 || height < 8) std::fill_n(depth_m, 64, kNoDepth);
  for (int v = 0; v < height; ++v) {
    std::memcpy(depth_m + 8 * v, image_m.row(v_begin + v) + u_begin, sizeof(float) * width);
  }
  const float parent_hi_m =
      search.to_shadow
          ? HUGE_VALF
          : view.space->cells.levels[0]
                .nodes[cell.v / 4 * view.space->cells.levels[0].node_columns + cell.u / 4]
                .hi_m[cell.half][cell.v % 4 * 4 + cell.u % 4];
  for (int i = 0; i < 64; i += kLanes) {
    const Lanes d = load(depth_m + i);
    const LaneMask valid =
        both(both(d >= Lanes(parent.d), d <= Lanes(parent_hi_m)), d <= Lanes(view.far_m));
    const Lanes depth = select(valid, d, Lanes(1.0f));
    const Lanes end = search.to_shadow
                          ? Lanes(view.far_m)
                          : least(depth + Lanes(slab_m), greatest(depth, Lanes(view.far_m)));
    store(depth, out.depth_m + i);
    store(end, out.end_m + i);
    const Chunks chunks = pixel_chunks(view, cell, i, depth, end);
    const Lanes bound = patch_bound(patch, chunks) - Lanes(view.frame.error_m);
    store(select(valid, bound, Lanes(HUGE_VALF)), out.m + i);
  }
}

/// A cell of 8 x 8 pixels: at a leaf its pixels are searched at once, the nearest first.
void split_pixels(ViewSearch& search, const Item& item, const ImageCell& cell, const Chunk& chunk,
                  Fresh& fresh) {
  const LinkView& view = search.views[cell.view];
  const int level = level_of(item.patch);
  const int index = index_of(item.patch);
  const Patches patch = broadcast_patch(search.link.link->levels[level], index, view.frame.motion);
  PixelBounds bounds;
  bound_pixels(search, patch, cell, chunk, bounds);
  const auto pixel_at = [&](int i) {
    return ImageCell{cell.view, ImageCell::kPixelLevel, 0, 8 * cell.u + i % 8, 8 * cell.v + i / 8};
  };
  if (level > 0) {
    for (int i = 0; i < 64; ++i) {
      if (bounds.m[i] < search.link.limit_m()) {
        fresh.add(bounds.m[i], item.patch, pixel_at(i).key());
      }
    }
    return;
  }
  while (true) {
    Lanes least_bound = load(bounds.m);
    for (int i = kLanes; i < 64; i += kLanes) least_bound = least(least_bound, load(bounds.m + i));
    const float least_m = least_lane(least_bound);
    if (!(least_m < search.link.limit_m())) return;
    int nearest = 0;
    while (bounds.m[nearest] != least_m) ++nearest;
    bounds.m[nearest] = HUGE_VALF;
    bound_by_plane(search, index, cell, search_pixel(search, index, pixel_at(nearest)), bounds);
  }
}

/// A cell of cells.
void split_cell(ViewSearch& search, const Item& item, const ImageCell& cell, const Chunk& chunk,
                Fresh& fresh) {
  const LinkView& view = search.views[cell.view];
  const int level = cell.level - 1;
  const DepthCells::Level& children = view.space->cells.levels[level];
  const DepthCells::Node& node = children.nodes[cell.v * children.node_columns + cell.u];
  const Patches patch = broadcast_patch(search.link.link->levels[level_of(item.patch)],
                                        index_of(item.patch), view.frame.motion);
  float parent_hi_m = HUGE_VALF;
  if (cell.level < view.space->cells.level_count) {
    const DepthCells::Level& own = view.space->cells.levels[cell.level];
    parent_hi_m = own.nodes[cell.v / 4 * own.node_columns + cell.u / 4]
                      .hi_m[cell.half][cell.v % 4 * 4 + cell.u % 4];
  }
  const auto side_px = static_cast<float>(children.cell_px);
  for (int half = 0; half < (search.to_shadow ? 1 : 2); ++half) {
    for (int i = 0; i < DepthCells::kChildren; i += kLanes) {
      const Lanes lo = load(node.lo_m[half] + i);
      const Lanes hi = load(node.hi_m[half] + i);
      LaneMask valid = both(both(lo >= Lanes(chunk.d), lo <= Lanes(view.far_m)), lo <= hi);
      if (!search.to_shadow) valid = both(valid, hi <= Lanes(parent_hi_m));
      if (bits_of(valid) == 0) continue;
      const Lanes place = count_up(static_cast<float>(i));
      const Lanes row = hn::Floor((place * Lanes(0.25f)).v);
      const Lanes u = (place - row * Lanes(4.0f) + Lanes(4.0f * cell.u)) * Lanes(side_px);
      const Lanes v = (row + Lanes(4.0f * cell.v)) * Lanes(side_px);
      const Lanes depth = select(valid, lo, Lanes(1.0f));
      const Lanes far(view.far_m);
      const Lanes end =
          search.to_shadow
              ? far
              : greatest(depth, least(select(valid, hi, Lanes(1.0f)) +
                                          Lanes(static_cast<float>(view.space->settings.slab_m)),
                                      far));
      const Lanes du(view.per_column), u0(view.first_column), dv(view.per_row), v0(view.first_row);
      const Chunks chunks{u * du + u0, (u + Lanes(side_px)) * du + u0,
                          v * dv + v0, (v + Lanes(side_px)) * dv + v0,
                          depth,       end};
      const Lanes bound = patch_bound(patch, chunks) - Lanes(view.frame.error_m);
      add_below(bound, search.link.limit_m(), bits_of(valid), [&](int lane, float bound_m) {
        const int child = i + lane;
        fresh.add(bound_m, item.patch,
                  ImageCell{cell.view, level, half, 4 * cell.u + child % 4, 4 * cell.v + child / 4}
                      .key());
      });
    }
  }
}

void expand(ViewSearch& search, const Item& item, Fresh& fresh) {
  const ImageCell cell = ImageCell::of_key(item.space);
  const LinkView& view = search.views[cell.view];
  const Chunk chunk = chunk_of(search, cell);
  const int level = level_of(item.patch);
  const PatchLevel& patches = search.link.link->levels[level];
  const int index = index_of(item.patch);
  const float patch_m = std::max(patches.half_height_m[index], patches.radius_m[index]);
  const float depth_m = search.to_shadow ? chunk.d : chunk.e;
  float chunk_m = std::max(chunk.a1 - chunk.a0, chunk.b1 - chunk.b0) * depth_m;
  if (!search.to_shadow) chunk_m = std::max(chunk_m, chunk.e - chunk.d);
  const bool is_pixel = cell.level == ImageCell::kPixelLevel;
  if (level > 0 && (is_pixel || 2 * patch_m >= chunk_m)) {
    bound_children(
        search.link, view.frame, item.patch, broadcast(chunk),
        [&](float bound_m, std::uint32_t patch) { fresh.add(bound_m, patch, item.space); });
  } else if (is_pixel) {
    search_pixel(search, index, cell);
  } else if (cell.level > 0) {
    split_cell(search, item, cell, chunk, fresh);
  } else {
    split_pixels(search, item, cell, chunk, fresh);
  }
}

void search_in_views(const HiddenSpace& space, bool to_shadow, int steps, LinkSearch& link) {
  ViewSearch search{link, to_shadow, {}};
  for (std::size_t k = 0; k < space.views().size(); ++k) {
    if (!space.views()[k].space->is_empty()) search.views[k] = make_view(space.views()[k], link);
  }
  search_best_first(link, steps,
                    [&](const Item& item, Fresh& fresh) HWY_ATTR { expand(search, item, fresh); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(search_in_views);

void search_views(const HiddenSpace& space, bool to_shadow, int steps, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(search_in_views)(space, to_shadow, steps, search);
}

void start_in_views(const HiddenSpace& space, LinkSearch& search) {
  search.items.clear();
  search.given_up_m = std::numeric_limits<float>::infinity();
  if (search.link->empty()) return;
  const auto top = patch_of(static_cast<int>(search.link->levels.size()) - 1, 0);
  for (std::size_t k = 0; k < space.views().size(); ++k) {
    const ViewSpace& view = *space.views()[k].space;
    if (view.is_empty()) continue;
    search.items.push(
        {0, top, ImageCell{static_cast<int>(k), view.cells.level_count, 0, 0, 0}.key()});
  }
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
