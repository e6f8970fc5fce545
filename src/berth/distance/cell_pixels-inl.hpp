// The search among the pixels of a cell.
#if defined(BERTH_MESH_CELL_PIXELS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_CELL_PIXELS_INL_HPP
#undef BERTH_MESH_CELL_PIXELS_INL_HPP
#else
#define BERTH_MESH_CELL_PIXELS_INL_HPP
#endif

#include <cstring>

#include "berth/distance/searched_camera-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// The leaf's triangles against one pixel.
inline LeafFound search_pixel(ViewSearch& search, int leaf, const ImageCell& pixel) {
  const SearchedCamera& view = search.views[pixel.view];
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

/// The 64 pixels of a cell and bounds of their distances, +inf where there is nothing.
struct CellPixels {
  alignas(64) float bound_m[64];
  alignas(64) float depth_m[64];
  alignas(64) float end_m[64];

  HWY_INLINE float least_bound_m() const {
    Lanes all = load(bound_m);
    for (int i = kLanes; i < 64; i += kLanes) all = least(all, load(bound_m + i));
    return least_lane(all);
  }
};

/// The pixels i, i + 1, ... of a cell.
HWY_INLINE Chunks pixel_chunks(const SearchedCamera& view, const ImageCell& cell, int i,
                               Lanes depth, Lanes end) {
  const Lanes place = count_up(static_cast<float>(i));
  const Lanes row = hn::Floor((place * Lanes(0.125f)).v);
  const Lanes u = place - row * Lanes(8.0f) + Lanes(static_cast<float>(8 * cell.u));
  const Lanes v = row + Lanes(static_cast<float>(8 * cell.v));
  const Lanes du(view.per_column), u0(view.first_column), dv(view.per_row), v0(view.first_row);
  return {u * du + u0, (u + Lanes(1.0f)) * du + u0, v * dv + v0, (v + Lanes(1.0f)) * dv + v0, depth,
          end};
}

inline void load_pixels(const ViewSearch& search, const ImageCell& cell, const Chunk& parent,
                        CellPixels& out) {
  const SearchedCamera& view = search.views[cell.view];
  const DepthView image_m = view.space->obstacle_depth_m;
  const float surface_thickness_m = static_cast<float>(view.space->settings.surface_thickness_m);
  const int u_begin = 8 * cell.u;
  const int v_begin = 8 * cell.v;
  const int width = std::min(8, image_m.width - u_begin);
  const int height = std::min(8, image_m.height - v_begin);
  if (width < 8 || height < 8) std::fill_n(out.depth_m, 64, kNoDepth);
  for (int v = 0; v < height; ++v) {
    std::memcpy(out.depth_m + 8 * v, image_m.row(v_begin + v) + u_begin, sizeof(float) * width);
  }
  const float parent_hi_m =
      search.to_shadow
          ? HUGE_VALF
          : view.space->cells.levels[0]
                .nodes[cell.v / 4 * view.space->cells.levels[0].node_columns + cell.u / 4]
                .hi_m[cell.half][cell.v % 4 * 4 + cell.u % 4];
  for (int i = 0; i < 64; i += kLanes) {
    const Lanes d = load(out.depth_m + i);
    const LaneMask valid =
        both(both(d >= Lanes(parent.d), d <= Lanes(parent_hi_m)), d <= Lanes(view.far_m));
    const Lanes depth = select(valid, d, Lanes(1.0f));
    const Lanes end = search.to_shadow ? Lanes(view.far_m)
                                       : least(depth + Lanes(surface_thickness_m),
                                               greatest(depth, Lanes(view.far_m)));
    store(depth, out.depth_m + i);
    store(end, out.end_m + i);
    store(select(valid, Lanes(-HUGE_VALF), Lanes(HUGE_VALF)), out.bound_m + i);
  }
}

/// Where a pixel was nearest to a patch, its neighbours are about as near: what lies before a plane
/// there is bounded by it.
HWY_INLINE void bound_by_plane(const SearchedCamera& view, const ImageCell& cell,
                               const Plane& plane, CellPixels& pixels) {
  for (int i = 0; i < 64; i += kLanes) {
    const Chunks chunks =
        pixel_chunks(view, cell, i, load(pixels.depth_m + i), load(pixels.end_m + i));
    store(greatest(load(pixels.bound_m + i), bound_of(plane, chunks)), pixels.bound_m + i);
  }
}

/// By a plane for each pixel, where one for all does not tell enough.
HWY_INLINE void bound_one_by_one(const ViewSearch& search, int leaf, const ImageCell& cell,
                                 CellPixels& pixels) {
  const SearchedCamera& view = search.views[cell.view];
  const Patches patch = broadcast_patch(search.link.link->levels[0], leaf, view.frame.motion);
  for (int i = 0; i < 64; i += kLanes) {
    const Lanes bound = load(pixels.bound_m + i);
    if (bits_of(bound < Lanes(search.link.limit_m())) == 0) continue;
    const Chunks chunks =
        pixel_chunks(view, cell, i, load(pixels.depth_m + i), load(pixels.end_m + i));
    store(greatest(bound, patch_bound(patch, chunks) - Lanes(view.frame.error_m)),
          pixels.bound_m + i);
  }
}

/// The pixels of a cell, the nearest first; returns how near none of them comes.
inline float search_pixels(ViewSearch& search, int leaf, const ImageCell& cell,
                           CellPixels& pixels) {
  const SearchedCamera& view = search.views[cell.view];
  bound_one_by_one(search, leaf, cell, pixels);
  float searched_m = HUGE_VALF;
  while (true) {
    const float least_m = pixels.least_bound_m();
    if (!(least_m < search.link.limit_m())) return std::min(least_m, searched_m);
    int nearest = 0;
    while (pixels.bound_m[nearest] != least_m) ++nearest;
    pixels.bound_m[nearest] = HUGE_VALF;
    const LeafFound found = search_pixel(
        search, leaf,
        {cell.view, ImageCell::kPixelLevel, 0, 8 * cell.u + nearest % 8, 8 * cell.v + nearest / 8});
    searched_m = std::min(searched_m, found.lower_m);
    const float along_m =
        least_along(search.link, view.frame, leaf, found.heading) - view.frame.error_m;
    bound_by_plane(view, cell, {found.heading, along_m}, pixels);
  }
}

/// Makes the children of an item's patch fresh that may be near enough to the pixels of a cell that
/// still count.
HWY_INLINE void part_patch_by_pixels(const ViewSearch& search, Item& item, const ImageCell& cell,
                                     const Chunk& chunk, const CellPixels& pixels, Fresh& fresh) {
  const SearchedCamera& view = search.views[cell.view];
  const int below = level_of(item.patch) - 1;
  const PatchLevel& level = search.link.link->levels[below];
  const int begin = 16 * index_of(item.patch);
  const int count = std::min(16, level.count - begin);
  const Lanes limit(search.link.limit_m());
  std::uint64_t near = 0;
  Lanes others(HUGE_VALF);
  for (int i = 0; i < 64; i += kLanes) {
    const Lanes bound = load(pixels.bound_m + i);
    near |= std::uint64_t{bits_of(bound < limit)} << i;
    others = least(others, select(bound < limit, Lanes(HUGE_VALF), bound));
  }
  const Lanes of_others(least_lane(others));
  Parting parting{item, search.link.limit_m()};
  for (int i = 0; i < count; i += kLanes) {
    const Patches patches = load_patches(level, begin + i, view.frame.motion);
    const Vectors n = direction(patches.centre, nearest_in<2>(broadcast(chunk), patches.centre)).n;
    const Lanes along = dot(patches.centre, n) - reach_along(patches, n);
    Lanes reach(-HUGE_VALF);
    for (std::uint64_t left = near; left != 0; left &= left - 1) {
      const int k = __builtin_ctzll(left);
      const auto u = static_cast<float>(8 * cell.u + k % 8);
      const auto v = static_cast<float>(8 * cell.v + k / 8);
      const Chunk pixel{u * view.per_column + view.first_column,
                        (u + 1) * view.per_column + view.first_column,
                        v * view.per_row + view.first_row,
                        (v + 1) * view.per_row + view.first_row,
                        pixels.depth_m[k],
                        pixels.end_m[k]};
      reach = greatest(reach, reach_of(broadcast(pixel), n));
    }
    const int rest = count - i;
    const std::uint32_t valid = rest >= 32 ? ~0u : (1u << rest) - 1;
    parting.part(least(along - reach - Lanes(view.frame.error_m), of_others), i, valid,
                 [&](int lane, float bound_m) {
                   fresh.add(bound_m, patch_of(below, begin + i + lane), item.space);
                 });
  }
  parting.end(16);
}

/// A cell of pixels and a patch: the pixels that count against its children, or against a leaf.
inline void expand_pixels(ViewSearch& search, Item& item, const ImageCell& cell, const Chunk& chunk,
                          Fresh& fresh) {
  const SearchedCamera& view = search.views[cell.view];
  const Plane plane = plane_towards(search, view, item.patch, chunk);
  const float chunk_m = hn::GetLane(bound_of(plane, broadcast(chunk)).v);
  item.bound_m = std::max(item.bound_m, chunk_m);
  if (!(chunk_m < search.link.limit_m())) return;
  CellPixels pixels;
  load_pixels(search, cell, chunk, pixels);
  bound_by_plane(view, cell, plane, pixels);
  const float pixels_m = pixels.least_bound_m();
  item.bound_m = std::max(item.bound_m, pixels_m);
  if (!(pixels_m < search.link.limit_m())) return;
  if (level_of(item.patch) == 0) {
    item.bound_m =
        std::max(item.bound_m, search_pixels(search, index_of(item.patch), cell, pixels));
  } else {
    part_patch_by_pixels(search, item, cell, chunk, pixels, fresh);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
