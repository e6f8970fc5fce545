#include <algorithm>

#include "berth/distance/link_search.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/cube_front.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/field_bound-inl.hpp"
#include "berth/distance/leaf-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// Where cubes lie in a link's frame, told from a corner that is near to all of them: so that
/// floats are enough.
struct NearCubes {
  Cube origin;
  Motion X_LO;
  float error_m;

  explicit NearCubes(const LinkSearch& search) : error_m(rounding_m(reach_of_cubes_m(search))) {
    const auto place = [&](int axis) {
      const double edges = (search.X_BL.translation()[axis] - Cube::kCorner_m) / Cube::kLeastEdge_m;
      return static_cast<int>(std::clamp(edges, 0.0, 1.0 * Cube::kCount));
    };
    origin = {0, place(0), place(1), place(2)};
    const Pose X_LB = search.X_BL.inverse();
    X_LO = motion_of(X_LB * Eigen::Translation3d(origin.corner_m()));
  }
};

/// A cube in each lane, by the corner next to the origin, in B's axes.
struct CubeLanes {
  alignas(64) float x_m[kLanes], y_m[kLanes], z_m[kLanes], edge_m[kLanes];

  void set(int lane, const NearCubes& near, const Cube& cube) {
    const int shift = 2 * cube.level;
    const auto least_m = static_cast<float>(Cube::kLeastEdge_m);
    x_m[lane] = least_m * static_cast<float>((cube.x << shift) - near.origin.x);
    y_m[lane] = least_m * static_cast<float>((cube.y << shift) - near.origin.y);
    z_m[lane] = least_m * static_cast<float>((cube.z << shift) - near.origin.z);
    edge_m[lane] = static_cast<float>(cube.edge_m());
  }
};

/// Corner i of each cube, in the link's frame.
HWY_INLINE Vectors corners_L_m(const NearCubes& near, const CubeLanes& cubes, int i) {
  const Vectors low_m = moved(near.X_LO, {load(cubes.x_m), load(cubes.y_m), load(cubes.z_m)});
  const auto along = [&](int row) {
    float sum = 0;
    for (int k = 0; k < 3; ++k) sum += i >> k & 1 ? near.X_LO.r[row][k] : 0.0f;
    return Lanes(sum);
  };
  return mul_add(load(cubes.edge_m), {along(0), along(1), along(2)}, low_m);
}

/// The least distances of cubes by the field at their corners; 0 where it does not tell.
HWY_INLINE Lanes cube_bounds(const NearCubes& near, const FieldPoints& field,
                             const CubeLanes& cubes) {
  const Lanes edge_m = load(cubes.edge_m);
  const Lanes zero(0.0f);
  Lanes f[8] = {zero, zero, zero, zero, zero, zero, zero, zero};
  LaneMask tells = zero >= zero;
  for (int i = 0; i < 8; ++i) {
    const Vectors corner_m = corners_L_m(near, cubes, i);
    // Where a point lies is rounded in two frames.
    const Lanes bound_m = root(field_bounds_m2(field, corner_m)) - Lanes(2 * near.error_m);
    tells = both(tells, bound_m > zero);
    f[i] = bound_m * bound_m;
  }
  return select(tells, least_distance(f, edge_m * edge_m), zero);
}

bool is_by_corners(const Item& item) {
  return (item.patch & kOpened) == 0 && Cube::of_key(item.space).level <= kGreatestByCorners;
}

/// Makes the field known around the corners of those cubes of which it does not tell: else what is
/// found would depend on what anybody has asked for before. Returns whether there was anything.
HWY_INLINE bool know_corners(const NearCubes& near, const FieldGrid& grid, const CubeLanes& cubes,
                             const float* bound_m, const std::uint32_t* places, int count,
                             const LinkSearch& search) {
  std::uint32_t untold = 0;
  for (int k = 0; k < count; ++k) {
    const bool is_told = bound_m[k] > 0 || !is_by_corners(search.front.item(places[k]));
    untold |= static_cast<std::uint32_t>(!is_told) << k;
  }
  bool has_found = false;
  for (int i = 0; i < 8 && untold != 0; ++i) {
    const Vectors corner_m = corners_L_m(near, cubes, i);
    alignas(64) float x_m[kLanes], y_m[kLanes], z_m[kLanes];
    store(corner_m.x, x_m);
    store(corner_m.y, y_m);
    store(corner_m.z, z_m);
    for (std::uint32_t left = untold; left != 0; left &= left - 1) {
      const int k = __builtin_ctz(left);
      const auto hint = static_cast<int>(search.front.item(places[k]).patch);
      has_found |= know_cell(grid, *search.link, {x_m[k], y_m[k], z_m[k]}, hint);
    }
  }
  return has_found;
}

/// Those of `count` items of the front at `places` that are no nearer than the limit stay there,
/// with what is known of them now.
HWY_INLINE void take_or_raise(const NearCubes& near, const FieldGrid& grid, float limit_m,
                              const std::uint32_t* places, int count, LinkSearch& search) {
  CubeLanes cubes;
  for (int i = 0; i < kLanes; ++i) {
    cubes.set(i, near, Cube::of_key(search.front.item(places[std::min(i, count - 1)]).space));
  }
  const FieldPoints field = grid.all();
  alignas(64) float bound_m[kLanes];
  store(cube_bounds(near, field, cubes), bound_m);
  if (know_corners(near, grid, cubes, bound_m, places, count, search)) {
    store(cube_bounds(near, field, cubes), bound_m);
  }
  for (int i = 0; i < count; ++i) {
    const Item& item = search.front.item(places[i]);
    if (is_by_corners(item)) {
      search.front.raise(places[i], bound_m[i]);
      if (bound_m[i] >= limit_m) continue;
    }
    search.front.take(places[i], search.items);
  }
}

void take_cubes(LinkSearch& search) {
  const float limit_m = search.limit_m();
  const FieldGrid* const grid = search.link->field->grid_for(limit_m);
  if (!grid) return search.front.take_below(limit_m, search.items);
  const NearCubes near(search);
  const std::vector<std::uint32_t>& places = search.front.find_below(limit_m);
  for (std::size_t i = 0; i < places.size(); i += kLanes) {
    const int count = static_cast<int>(std::min<std::size_t>(kLanes, places.size() - i));
    take_or_raise(near, *grid, limit_m, &places[i], count, search);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(take_cubes);

void take_cubes_below(LinkSearch& search) { HWY_DYNAMIC_DISPATCH(take_cubes)(search); }

void start_in_cubes(LinkSearch& search) {
  begin_front(search);
  if (search.link->empty()) return;
  const int top_level = static_cast<int>(search.link->levels.size()) - 1;
  const PatchLevel& top = search.link->levels[top_level];
  const Eigen::Vector3d centre_B_m =
      search.X_BL * Eigen::Vector3d(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double reach_m =
      static_cast<double>(top.half_height_m[0]) + top.radius_m[0] + search.known_range_m();
  constexpr int kSide = Cube::kCount >> 2 * Cube::kTopLevel;
  int begin[3], end[3];
  for (int i = 0; i < 3; ++i) {
    begin[i] = top_cube_at(centre_B_m[i] - reach_m);
    end[i] = top_cube_at(centre_B_m[i] + reach_m) + 1;
    search.is_beyond_cubes |= begin[i] < 0 || end[i] > kSide;
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
            {.bound_m = static_cast<float>(std::max(bound_m, 0.0)), .space = cube.key()});
      }
    }
  }
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
