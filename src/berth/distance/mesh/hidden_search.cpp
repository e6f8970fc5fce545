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

/// A cube some of whose points may be hidden, against a leaf: its centre is tried; returns a bound
/// by the plane through the triangles' point nearest to it.
float search_mixed(CubeSearch& search, int leaf, const Cube& cube) {
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
  const Eigen::Vector3d centre_m = cube.corner_m().array() + half_m;
  if (least_m + search.frame.error_m < link.best_m && search.space.hiding_pixel(centre_m)) {
    link.best_m = least_m + search.frame.error_m;
    link.best_triangle = std::min(triangle, link.link->triangle_count - 1);
    link.best_point_B_m = centre_m.cast<float>();
    link.best_is_hidden = true;
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

void split_cube(CubeSearch& search, const Item& item, const Cube& cube, Fresh& fresh) {
  const CubeBlock block = search.space.block(cube);
  if (block.possible == 0) return;
  const int level = level_of(item.patch);
  const int index = index_of(item.patch);
  const Patches patch =
      broadcast_patch(search.link.link->levels[level], index, search.frame.motion);
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  const Eigen::Vector3f corner = cube.corner_m().cast<float>();
  for (int i = 0; i < 64; i += kLanes) {
    const auto possible = static_cast<std::uint32_t>(block.possible >> i) & ((1u << kLanes) - 1);
    if (possible == 0) continue;
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
    const Lanes bound = patch_bound(patch, boxes) - Lanes(search.frame.error_m);
    add_below(bound, search.link.limit_m(), possible, [&](int lane, float bound_m) HWY_ATTR {
      if (!(bound_m < search.link.limit_m())) return;
      const Cube child = cube.child(i + lane);
      const bool is_full = block.full >> (i + lane) & 1;
      if (is_full && level == 0) {
        search_full(search, index, child);
        return;
      }
      if (!is_full && level == 0) bound_m = std::max(bound_m, search_mixed(search, index, child));
      if (!is_full && child.level == 0) {
        search.link.given_up_m = std::min(search.link.given_up_m, std::max(bound_m, 0.0f));
      } else if (bound_m < search.link.limit_m()) {
        fresh.add(bound_m, item.patch, child.key() | (is_full ? kFullCube : 0));
      }
    });
  }
}

void expand(CubeSearch& search, const Item& item, Fresh& fresh) {
  const Cube cube = Cube::of_key(item.space);
  const bool is_full = (item.space & kFullCube) != 0;
  const int level = level_of(item.patch);
  const PatchLevel& patches = search.link.link->levels[level];
  const int index = index_of(item.patch);
  const float patch_m = std::max(patches.half_height_m[index], patches.radius_m[index]);
  if (level > 0 && (is_full || 2 * patch_m >= static_cast<float>(cube.edge_m()))) {
    bound_children(
        search.link, search.frame, item.patch, box_of(cube),
        [&](float bound_m, std::uint32_t patch) { fresh.add(bound_m, patch, item.space); });
  } else if (is_full) {
    search_full(search, index, cube);
  } else {
    split_cube(search, item, cube, fresh);
  }
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

void start_in_cubes(LinkSearch& search) {
  search.items.clear();
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
  for (int z = begin[2]; z < end[2]; ++z) {
    for (int y = begin[1]; y < end[1]; ++y) {
      for (int x = begin[0]; x < end[0]; ++x) {
        const Cube cube{Cube::kTopLevel, x, y, z};
        const Eigen::Vector3d low_m = cube.corner_m();
        const Eigen::Vector3d high_m = low_m.array() + cube.edge_m();
        const Eigen::Vector3d nearest_m = centre_B_m.cwiseMax(low_m).cwiseMin(high_m);
        const double bound_m =
            (nearest_m - centre_B_m).norm() - top.half_height_m[0] - top.radius_m[0] - 1e-5;
        search.items.push(
            {static_cast<float>(std::max(bound_m, 0.0)), patch_of(top_level, 0), cube.key()});
      }
    }
  }
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
