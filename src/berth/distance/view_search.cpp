#include <algorithm>
#include <cmath>

#include "berth/distance/link_search.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/view_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/cell_pixels-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// How an item is taken apart; once some of its children are gone, the rest stay of that kind.
enum Way : std::uint32_t { kWhole, kByPatch, kByCell };

/// The cells of a cell, in both of their depth ranges.
void part_cell(ViewSearch& search, Item& item, const ImageCell& cell, const Chunk& chunk,
               Fresh& fresh) {
  const SearchedCamera& view = search.views[cell.view];
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
  const int halves = search.to_shadow ? 1 : 2;
  Parting parting{item, search.link.limit_m()};
  for (int half = 0; half < halves; ++half) {
    for (int i = 0; i < DepthCells::kChildren; i += kLanes) {
      const Lanes lo = load(node.lo_m[half] + i);
      const Lanes hi = load(node.hi_m[half] + i);
      LaneMask valid = both(lo >= Lanes(chunk.d), lo <= hi);
      if (!search.to_shadow) valid = both(valid, hi <= Lanes(parent_hi_m));
      const Lanes place = count_up(static_cast<float>(i));
      const Lanes row = hn::Floor((place * Lanes(0.25f)).v);
      const Lanes u = (place - row * Lanes(4.0f) + Lanes(4.0f * cell.u)) * Lanes(side_px);
      const Lanes v = (row + Lanes(4.0f * cell.v)) * Lanes(side_px);
      const Lanes far(view.far_m);
      const LaneMask in_reach = both(valid, lo <= far);
      const Lanes depth = select(in_reach, lo, Lanes(1.0f));
      const Lanes end =
          search.to_shadow
              ? far
              : greatest(
                    depth,
                    least(select(in_reach, hi, Lanes(1.0f)) +
                              Lanes(static_cast<float>(view.space->settings.surface_thickness_m)),
                          far));
      const Lanes du(view.per_column), u0(view.first_column), dv(view.per_row), v0(view.first_row);
      const Chunks chunks{u * du + u0, (u + Lanes(side_px)) * du + u0,
                          v * dv + v0, (v + Lanes(side_px)) * dv + v0,
                          depth,       end};
      const Lanes bound = select(in_reach, patch_bound(patch, chunks) - Lanes(view.frame.error_m),
                                 Lanes(HUGE_VALF));
      parting.part(
          bound, DepthCells::kChildren * half + i, bits_of(valid), [&](int lane, float bound_m) {
            const int child = i + lane;
            fresh.add(
                bound_m, item.patch,
                ImageCell{cell.view, level, half, 4 * cell.u + child % 4, 4 * cell.v + child / 4}
                    .key());
          });
    }
  }
  parting.end(DepthCells::kChildren * halves);
}

/// Whether the search goes on among a patch's children instead of a cell's.
bool is_greater(const PatchLevel& patches, int index, bool to_shadow, const Chunk& chunk) {
  const float patch_m = std::max(patches.half_height_m[index], patches.radius_m[index]);
  const float depth_m = to_shadow ? chunk.d : chunk.e;
  float chunk_m = std::max(chunk.a1 - chunk.a0, chunk.b1 - chunk.b0) * depth_m;
  if (!to_shadow) chunk_m = std::max(chunk_m, chunk.e - chunk.d);
  return 2 * patch_m >= chunk_m;
}

void expand(ViewSearch& search, Item& item, Fresh& fresh) {
  const ImageCell cell = ImageCell::of_key(item.space);
  const SearchedCamera& view = search.views[cell.view];
  const Chunk chunk = chunk_of(search, cell);
  if (cell.level == 0) return expand_pixels(search, item, cell, chunk, fresh);
  const int level = level_of(item.patch);
  const int index = index_of(item.patch);
  const bool is_pixel = cell.level == ImageCell::kPixelLevel;
  if (is_pixel && level == 0) {
    item.bound_m = std::max(item.bound_m, search_pixel(search, index, cell).lower_m);
    return;
  }
  if (item.way == kWhole) {
    const bool by_patch = level > 0 && (is_pixel || is_greater(search.link.link->levels[level],
                                                               index, search.to_shadow, chunk));
    item.way = by_patch ? kByPatch : kByCell;
  }
  if (item.way == kByPatch) {
    part_patch(search.link, view.frame, item, broadcast(chunk), fresh);
  } else {
    part_cell(search, item, cell, chunk, fresh);
  }
}

void search_in_views(const UnknownSpace& space, bool to_shadow, int steps, LinkSearch& link) {
  ViewSearch search{link, to_shadow, {}};
  for (std::size_t k = 0; k < space.views().size(); ++k) {
    const FreeingCamera& view = to_shadow ? space.shadow_view() : space.views()[k];
    if (!view.space->is_empty()) search.views[k] = make_view(view, link);
  }
  search_best_first(link, steps,
                    [&](Item& item, Fresh& fresh) HWY_ATTR { expand(search, item, fresh); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(search_in_views);

void search_views(const UnknownSpace& space, bool to_shadow, int steps, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(search_in_views)(space, to_shadow, steps, search);
}

void start_in_views(const UnknownSpace& space, LinkSearch& search) {
  begin_front(search);
  if (search.link->empty()) return;
  const auto top = patch_of(static_cast<int>(search.link->levels.size()) - 1, 0);
  for (std::size_t k = 0; k < space.views().size(); ++k) {
    const CameraSpace& view = *space.views()[k].space;
    if (view.is_empty()) continue;
    const ImageCell all{static_cast<int>(k), view.cells.level_count, 0, 0, 0};
    search.items.push({.patch = top, .space = all.key()});
  }
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
