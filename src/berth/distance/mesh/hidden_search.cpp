#include <algorithm>
#include <cmath>

#include "berth/distance/mesh/link_search.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/mesh/hidden_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/mesh/leaf-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

struct CubeSearch {
  LinkSearch& link;
  const HiddenSpace& space;
  Frame frame;
};

HWY_INLINE Boxes box_of(const Cube& cube) {
  const double half_m = cube.edge_m() / 2;
  const Eigen::Vector3f centre = (cube.corner_m().array() + half_m).cast<float>();
  return {{Lanes(centre.x()), Lanes(centre.y()), Lanes(centre.z())},
          Lanes(static_cast<float>(half_m))};
}

void search_full(CubeSearch& search, int leaf, const Cube& cube) {
  Eigen::Vector3d corners_m[8];
  for (int i = 0; i < 8; ++i) {
    corners_m[i] = cube.corner_m() + cube.edge_m() * Eigen::Vector3d(i & 1, i >> 1 & 1, i >> 2);
  }
  search_leaf(search.link, search.frame, leaf, box_of(cube), corners_m,
              [&](const Eigen::Vector3f& point_B_m) {
                search.link.best_point_B_m = point_B_m;
                search.link.best_is_hidden = true;
              });
}

/// A point, and how far one of the link's is from it.
void try_point(CubeSearch& search, const Eigen::Vector3f& point_B_m, int triangle,
               float distance_m) {
  LinkSearch& link = search.link;
  if (!(distance_m + search.frame.error_m < link.best_m)) return;
  if (!search.space.hiding_pixel(point_B_m.cast<double>())) return;
  link.best_m = distance_m + search.frame.error_m;
  link.best_triangle = std::min(triangle, link.link->triangle_count - 1);
  link.best_point_B_m = point_B_m;
  link.best_is_hidden = true;
}

/// A cube some of whose points may be hidden, against a leaf: its centre and its point nearest to
/// the leaf are tried, unless another leaf was nearer (nearest_leaf_m); returns a bound by the
/// plane through the triangles' point nearest to it.
float search_mixed(CubeSearch& search, int leaf, const Cube& cube, float& nearest_leaf_m) {
  const Boxes box = box_of(cube);
  const double half_m = cube.edge_m() / 2;
  LinkSearch& link = search.link;
  float least_m = HUGE_VALF;
  int triangle = 0;
  Eigen::Vector3f nearest_m = Eigen::Vector3f::Zero();
  for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
    const Triangles t = load_triangles(*link.link, first, search.frame.motion);
    const Vectors p = nearest_in(t, box.centre);
    const Vectors v = p - box.centre;
    const Lanes length = root(dot(v, v));
    const float m = least_lane(length);
    if (m >= least_m) continue;
    least_m = m;
    const int lane = __builtin_ctz(bits_of(length <= Lanes(m)));
    alignas(64) float x[kLanes], y[kLanes], z[kLanes];
    store(v.x, x);
    store(v.y, y);
    store(v.z, z);
    nearest_m = {x[lane], y[lane], z[lane]};
    triangle = first + lane;
  }
  const Eigen::Vector3f centre_m = (cube.corner_m().array() + half_m).cast<float>();
  const auto half = static_cast<float>(half_m);
  if (least_m < nearest_leaf_m) {
    nearest_leaf_m = least_m;
    const Eigen::Vector3f towards_m = nearest_m.cwiseMax(-half).cwiseMin(half);
    try_point(search, centre_m + towards_m, triangle, (nearest_m - towards_m).norm());
    try_point(search, centre_m, triangle, least_m);
  }
  float bound_m = least_m - 1.7321f * static_cast<float>(half_m);
  const float scale = 1 / std::max(least_m, 1e-12f);
  const Vectors n{Lanes(nearest_m.x() * scale), Lanes(nearest_m.y() * scale),
                  Lanes(nearest_m.z() * scale)};
  Lanes along(HUGE_VALF);
  for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
    along = least(along, least_along(load_triangles(*link.link, first, search.frame.motion), n));
  }
  bound_m = std::max(bound_m, least_lane(along - reach_of(box, n)));
  return bound_m - search.frame.error_m;
}

/// The patches that can be nearest to some point of a cube, and how near at least.
struct Candidates {
  static constexpr int kMost = 512;
  int count = 0;
  std::uint32_t patch[kMost + 16];
  alignas(64) float lower_m[kMost + 16];
  alignas(64) float upper_m[kMost + 16];
  /// Their cylinders in the link's frame: centre, axis, half height, radius.
  alignas(64) float values[8][kMost + 16];

  void add(const LinkPatches& link, std::uint32_t p) {
    const PatchLevel& level = link.levels[level_of(p)];
    const int index = index_of(p);
    for (int k = 0; k < 3; ++k) {
      values[k][count] = level.centre_m[k][index];
      values[3 + k][count] = level.axis[k][index];
    }
    values[6][count] = level.half_height_m[index];
    values[7][count] = level.radius_m[index];
    patch[count++] = p;
  }
};

HWY_INLINE Patches load_candidates(const Candidates& c, int first, const Motion& X) {
  const auto at = [&](int k) { return load(c.values[k] + first); };
  return {moved(X, {at(0), at(1), at(2)}), turned(X, {at(3), at(4), at(5)}), at(6), at(7)};
}

/// Sets lower_m, no point of the cube is nearer to the patch, and upper_m, one of the patch's is no
/// farther from the cube's centre.
HWY_INLINE void bound_candidates(const CubeSearch& search, const Boxes& box, Candidates& c) {
  for (int i = 0; i < c.count; i += kLanes) {
    const Patches patches = load_candidates(c, i, search.frame.motion);
    store(patch_bound(patches, box) - Lanes(search.frame.error_m), c.lower_m + i);
    const Direction to = direction(patches.centre, box.centre);
    const Lanes radius =
        root(patches.half_height * patches.half_height + patches.radius * patches.radius);
    store(to.length + radius + Lanes(search.frame.error_m), c.upper_m + i);
  }
}

/// The distance of a leaf's triangles from the cube's centre.
float centre_distance_m(const CubeSearch& search, const Boxes& box, int leaf) {
  Lanes least_length(HUGE_VALF);
  for (int first = 16 * leaf; first < 16 * (leaf + 1); first += kLanes) {
    const Triangles t = load_triangles(*search.link.link, first, search.frame.motion);
    const Vectors v = nearest_in(t, box.centre) - box.centre;
    least_length = least(least_length, dot(v, v));
  }
  return std::sqrt(least_lane(least_length)) + search.frame.error_m;
}

/// Leaves the patches of `now` that can be nearest to some point of the cube, cut into ones smaller
/// than it, or with `to_leaves` into leaves.
void refine_candidates(const CubeSearch& search, const Cube& cube, bool to_leaves, Candidates*& now,
                       Candidates*& spare) {
  const Boxes box = box_of(cube);
  const LinkPatches& link = *search.link.link;
  const auto edge_m = static_cast<float>(cube.edge_m());
  const float half_diagonal_m = 0.866026f * edge_m;
  float centre_m = HUGE_VALF;
  while (true) {
    Candidates& c = *now;
    Candidates& next = *spare;
    bound_candidates(search, box, c);
    int nearest = 0;
    for (int i = 0; i < c.count; ++i) {
      centre_m = std::min(centre_m, c.upper_m[i]);
      if (c.lower_m[i] < c.lower_m[nearest]) nearest = i;
    }
    if (c.count > 1 && level_of(c.patch[nearest]) == 0) {
      centre_m = std::min(centre_m, centre_distance_m(search, box, index_of(c.patch[nearest])));
    }
    const float most_m = std::min(centre_m + half_diagonal_m, search.link.limit_m());
    bool is_split = false;
    next.count = 0;
    for (int i = 0; i < c.count; ++i) {
      if (c.lower_m[i] > most_m) continue;
      const int level = level_of(c.patch[i]);
      const int index = index_of(c.patch[i]);
      const float size_m = 2 * std::max(c.values[6][i], c.values[7][i]);
      const bool has_room = next.count + 16 + (c.count - i) <= Candidates::kMost;
      if (level == 0 || !has_room || !(to_leaves || size_m >= edge_m)) {
        next.add(link, c.patch[i]);
        continue;
      }
      is_split = true;
      const int end = std::min(16 * (index + 1), link.levels[level - 1].count);
      for (int child = 16 * index; child < end; ++child) next.add(link, patch_of(level - 1, child));
    }
    std::swap(now, spare);
    if (!is_split) return;
  }
}

void search_full_cube(CubeSearch& search, const Cube& cube, Candidates& c) {
  bound_candidates(search, box_of(cube), c);
  for (int i = 0; i < c.count; ++i) {
    if (level_of(c.patch[i]) != 0) {
      // No room for all leaves at once.
      search.link.given_up_m = std::min(search.link.given_up_m, std::max(c.lower_m[i], 0.0f));
    } else if (c.lower_m[i] < search.link.limit_m()) {
      search_full(search, index_of(c.patch[i]), cube);
    }
  }
}

/// No point of the cube, some of which may be hidden, is nearer; by planes through its nearest
/// points of the leaves among the candidates.
float sharpen(CubeSearch& search, const Cube& cube, Candidates& c) {
  bound_candidates(search, box_of(cube), c);
  float least_m = HUGE_VALF;
  float nearest_leaf_m = HUGE_VALF;
  for (int i = 0; i < c.count; ++i) {
    float bound_m = c.lower_m[i];
    if (bound_m < search.link.limit_m() && level_of(c.patch[i]) == 0) {
      bound_m = std::max(bound_m, search_mixed(search, index_of(c.patch[i]), cube, nearest_leaf_m));
    }
    least_m = std::min(least_m, bound_m);
  }
  return least_m;
}

/// The bounds of a cube's children.
struct ChildBounds {
  alignas(64) float m[64];
};

HWY_INLINE void bound_child_cubes(const CubeSearch& search, const Cube& cube, const Candidates& c,
                                  std::uint64_t possible, ChildBounds& out) {
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  const Eigen::Vector3f corner = cube.corner_m().cast<float>();
  for (int i = 0; i < 64; i += kLanes) {
    if ((possible >> i & ((1u << kLanes) - 1)) == 0) continue;
    const Lanes place = count_up(static_cast<float>(i));
    const Lanes layer = hn::Floor((place * Lanes(1.0f / 16)).v);
    const Lanes in_layer = place - layer * Lanes(16.0f);
    const Lanes row = hn::Floor((in_layer * Lanes(0.25f)).v);
    const Lanes column = in_layer - row * Lanes(4.0f);
    const Lanes edge(edge_m), middle(0.5f);
    const Boxes boxes{{mul_add(edge, column + middle, Lanes(corner.x())),
                       mul_add(edge, row + middle, Lanes(corner.y())),
                       mul_add(edge, layer + middle, Lanes(corner.z()))},
                      Lanes(0.5f * edge_m)};
    Lanes bound(HUGE_VALF);
    for (int k = 0; k < c.count; ++k) {
      const PatchLevel& level = search.link.link->levels[level_of(c.patch[k])];
      const Patches patch = broadcast_patch(level, index_of(c.patch[k]), search.frame.motion);
      bound = least(bound, patch_bound(patch, boxes));
    }
    store(bound - Lanes(search.frame.error_m), out.m + i);
  }
}

/// A cube of the least size, of which nobody can say whether it is hidden: no nearer point was
/// missed than the bound that planes through the triangles give.
void give_up(CubeSearch& search, const Cube& cube, const Candidates& parent) {
  Candidates buffers[2];
  buffers[0] = parent;
  Candidates* now = &buffers[0];
  Candidates* spare = &buffers[1];
  refine_candidates(search, cube, true, now, spare);
  if (now->count == 0) return;
  LinkSearch& link = search.link;
  const float bound_m = sharpen(search, cube, *now);
  if (bound_m < link.limit_m()) link.given_up_m = std::min(link.given_up_m, std::max(bound_m, 0.0f));
}

void split_cube(CubeSearch& search, const Cube& cube, const Candidates& c, Fresh& fresh) {
  const CubeBlock block = search.space.block(cube);
  if (block.possible == 0) return;
  LinkSearch& link = search.link;
  ChildBounds bounds;
  bound_child_cubes(search, cube, c, block.possible, bounds);
  std::uint32_t list = 0;
  bool has_list = false;
  for (std::uint64_t left = block.possible; left != 0; left &= left - 1) {
    const int i = __builtin_ctzll(left);
    const float bound_m = bounds.m[i];
    if (!(bound_m < link.limit_m())) continue;
    const Cube child = cube.child(i);
    const bool is_full = block.full >> i & 1;
    if (!is_full && child.level == 0) {
      // A bound by patches of a centimetre is not the last word.
      if (bound_m < link.given_up_m) give_up(search, child, c);
      continue;
    }
    if (!has_list) {
      list = keep_list(c.patch, c.count, link);
      has_list = true;
    }
    fresh.add(bound_m, list, child.key() | (is_full ? kFullCube : 0));
  }
}

/// Marks an item whose bound is as sharp as planes make it.
constexpr std::uint32_t kSharp = 1u << 31;

/// Whether triangles bound the cube's distance better than patches do.
bool is_small(const CubeSearch& search, const Cube& cube, const Candidates& c) {
  return level_of(c.patch[0]) == 0 &&
         cube.edge_m() < search.link.link->levels[0].radius_m[index_of(c.patch[0])];
}

void expand(CubeSearch& search, const Item& item, Fresh& fresh) {
  const Cube cube = Cube::of_key(item.space);
  const bool is_full = (item.space & kFullCube) != 0;
  Candidates buffers[2];
  Candidates* now = &buffers[0];
  Candidates* spare = &buffers[1];
  const std::uint32_t* list = search.link.patch_lists.data() + (item.patch & ~kSharp);
  for (std::uint32_t i = 0; i < *list; ++i) now->add(*search.link.link, list[1 + i]);
  refine_candidates(search, cube, is_full, now, spare);
  if (is_full) {
    search_full_cube(search, cube, *now);
    return;
  }
  if (now->count == 0) return;
  if ((item.patch & kSharp) == 0 && is_small(search, cube, *now)) {
    const float bound_m = std::max(item.bound_m, sharpen(search, cube, *now));
    if (!(bound_m < search.link.limit_m())) return;
    if (bound_m > search.link.items.least_bound_m()) {
      const std::uint32_t place = keep_list(now->patch, now->count, search.link);
      fresh.add(bound_m, place | kSharp, item.space);
      return;
    }
  }
  split_cube(search, cube, *now, fresh);
}

void search_in_cubes(const HiddenSpace& space, int steps, LinkSearch& link) {
  const PatchLevel& top = link.link->levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double reach_m = centre_L_m.norm() + link.X_BL.translation().norm() + top.half_height_m[0] +
                         top.radius_m[0] + link.range_m;
  CubeSearch search{link, space, make_frame(link.X_BL, static_cast<float>(reach_m))};
  search_best_first(link, steps,
                    [&](const Item& item, Fresh& fresh) HWY_ATTR { expand(search, item, fresh); });
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(search_in_cubes);

void search_cubes(const HiddenSpace& space, int steps, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(search_in_cubes)(space, steps, search);
}

std::uint32_t keep_list(const std::uint32_t* patches, int count, LinkSearch& search) {
  const auto place = static_cast<std::uint32_t>(search.patch_lists.size());
  search.patch_lists.push_back(static_cast<std::uint32_t>(count));
  search.patch_lists.insert(search.patch_lists.end(), patches, patches + count);
  return place;
}

void start_in_cubes(LinkSearch& search) {
  search.items.clear();
  search.patch_lists.clear();
  search.given_up_m = std::numeric_limits<float>::infinity();
  if (search.link->empty()) return;
  const int top_level = static_cast<int>(search.link->levels.size()) - 1;
  const PatchLevel& top = search.link->levels[top_level];
  const Eigen::Vector3d centre_B_m =
      search.X_BL * Eigen::Vector3d(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double reach_m = static_cast<double>(top.half_height_m[0]) + top.radius_m[0] +
                         std::max(0.0f, search.limit_m());
  constexpr int kSide = Cube::kCount >> 2 * Cube::kTopLevel;
  int begin[3], end[3];
  for (int i = 0; i < 3; ++i) {
    begin[i] = top_cube_at(centre_B_m[i] - reach_m);
    end[i] = top_cube_at(centre_B_m[i] + reach_m) + 1;
    // Beyond all cubes nothing is known.
    if (begin[i] < 0 || end[i] > kSide) search.given_up_m = 0;
    begin[i] = std::clamp(begin[i], 0, kSide);
    end[i] = std::clamp(end[i], 0, kSide);
  }
  const std::uint32_t top_patch = patch_of(top_level, 0);
  const std::uint32_t list = keep_list(&top_patch, 1, search);
  for (int z = begin[2]; z < end[2]; ++z) {
    for (int y = begin[1]; y < end[1]; ++y) {
      for (int x = begin[0]; x < end[0]; ++x) {
        const Cube cube{Cube::kTopLevel, x, y, z};
        const Eigen::Vector3d low_m = cube.corner_m();
        const Eigen::Vector3d high_m = low_m.array() + cube.edge_m();
        const Eigen::Vector3d nearest_m = centre_B_m.cwiseMax(low_m).cwiseMin(high_m);
        const double bound_m =
            (nearest_m - centre_B_m).norm() - top.half_height_m[0] - top.radius_m[0] - 1e-5;
        search.items.push({static_cast<float>(std::max(bound_m, 0.0)), list, cube.key()});
      }
    }
  }
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
