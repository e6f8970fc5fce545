#include <algorithm>
#include <cmath>
#include <optional>

#include "berth/distance/link_search.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/unknown_search.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/cube_corners-inl.hpp"
#include "berth/distance/field_bound-inl.hpp"
#include "berth/distance/leaf-inl.hpp"
#include "berth/distance/nearest_point-inl.hpp"
#include "berth/distance/top_patches-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// A search for one link among the cubes of unknown space. A cube's distance is bounded by those of
/// its corners; where nothing is hidden in it, it is dropped before these are asked for.
struct CubeSearch {
  LinkSearch& link;
  const UnknownSpace& space;
  Pose X_LB;
  NearestPointSearch mesh;
  TopPatches patches;
  float error_m;
};

Eigen::Vector3f in_link(const CubeSearch& search, const Eigen::Vector3d& p_B_m) {
  return (search.X_LB * p_B_m).cast<float>();
}

/// How near the link is to the corners of a cube, at least; `hint` is a leaf that may be near to
/// them, and becomes one that is.
CubeCorners exact_corners(CubeSearch& search, const Cube& cube, float bound_m, int& hint) {
  CubeCorners corners;
  NearPoints unknown;
  int place[8];
  const auto corner = [&](int i) {
    return Cube{cube.level, cube.x + (i & 1), cube.y + (i >> 1 & 1), cube.z + (i >> 2)};
  };
  for (int i = 0; i < 8; ++i) {
    const std::uint64_t key = corner(i).key();
    const CornerStore::Corner& kept = search.link.corners.at(key);
    if (kept.key == key && kept.request == search.link.request) {
      corners.squared_m2[i] = kept.squared_m2;
      hint = kept.leaf;
    } else {
      place[unknown.count] = i;
      unknown.p_L_m[unknown.count++] = in_link(search, corner(i).corner_m());
    }
  }
  if (unknown.count == 0) return corners;
  // What lies between the corners costs up to seven times as much.
  const auto edge_m = static_cast<float>(cube.edge_m());
  const float slack_m = 0.05f * edge_m * edge_m / std::max(bound_m, edge_m);
  search.mesh.find(hint, slack_m, unknown);
  for (int k = 0; k < unknown.count; ++k) {
    const int i = place[k];
    const std::uint64_t key = corner(i).key();
    const float distance_m = unknown.distance[k].lower_m;
    corners.squared_m2[i] = distance_m * distance_m;
    hint = unknown.distance[k].triangle / LinkPatches::kChildren;
    search.link.corners.at(key) = {key, corners.squared_m2[i], hint, search.link.request};
  }
  return corners;
}

/// How near the link is to the corners of a cube at least, by its field: less than it is, and known
/// sooner. All 0 where no grid reports.
struct FieldCorners {
  CubeCorners corners = {};
  /// Of the grid; 0 where none reports.
  float grid_edge_m = 0;
};

/// Where a cube's corners lie in the link's frame.
struct CornerPoints {
  static constexpr int kCount = kLanes > 8 ? kLanes : 8;
  alignas(64) float x_m[kCount] = {}, y_m[kCount] = {}, z_m[kCount] = {};

  CornerPoints(const CubeSearch& search, const Cube& cube) {
    const Eigen::Vector3f low_m = in_link(search, cube.corner_m());
    const Eigen::Matrix3f edges_m = (cube.edge_m() * search.X_LB.linear()).cast<float>();
    for (int i = 0; i < 8; ++i) {
      Eigen::Vector3f p_m = low_m;
      for (int k = 0; k < 3; ++k) {
        if (i >> k & 1) p_m += edges_m.col(k);
      }
      x_m[i] = p_m.x();
      y_m[i] = p_m.y();
      z_m[i] = p_m.z();
    }
  }
  Vectors many(int first) const {
    return {load(x_m + first), load(y_m + first), load(z_m + first)};
  }
  Eigen::Vector3f one(int i) const { return {x_m[i], y_m[i], z_m[i]}; }
};

FieldCorners field_corners(const CubeSearch& search, const Cube& cube, float bound_m, int hint) {
  const FieldGrid* const grid = search.link.link->field->grid_for(bound_m);
  if (!grid) return {};
  const CornerPoints points(search, cube);
  const FieldPoints field = grid->all();
  alignas(64) float bound_m2[CornerPoints::kCount];
  for (int i = 0; i < 8; i += kLanes) store(field_bounds_m2(field, points.many(i)), bound_m2 + i);
  FieldCorners out;
  for (int i = 0; i < 8; ++i) {
    if (!(bound_m2[i] > 0)) {
      bound_m2[i] = field_bound_m2(*grid, *search.link.link, points.one(i), hint);
    }
    // Where a point lies is rounded in two frames.
    const float rounded_m = std::sqrt(bound_m2[i]) - 2 * search.error_m;
    if (!(rounded_m > 0)) return {};
    out.corners.squared_m2[i] = rounded_m * rounded_m;
  }
  out.grid_edge_m = grid->edge_m();
  return out;
}

/// The greatest cubes at this distance of which what lies between the corners costs at most
/// half of the tolerance: smaller ones need no corners of their own.
int level_of_corners(const LinkSearch& link, float distance_m) {
  int level = 0;
  while (level < kGreatestByCorners) {
    const auto edge_m = static_cast<float>(Cube{level + 1, 0, 0, 0}.edge_m());
    if (!(0.75f * edge_m * edge_m <= link.tolerance_m * distance_m)) break;
    ++level;
  }
  return level;
}

/// The corners of a cube, from those of the cube of `level` that it is part of if that is greater.
CubeCorners corners_of(CubeSearch& search, const Cube& cube, float bound_m, int& hint) {
  const int level = level_of_corners(search.link, bound_m);
  if (cube.level >= level) return exact_corners(search, cube, bound_m, hint);
  const int shift = 2 * (level - cube.level);
  const Cube whole{level, cube.x >> shift, cube.y >> shift, cube.z >> shift};
  const CubeCorners corners = exact_corners(search, whole, bound_m, hint);
  const auto part = 1.0f / static_cast<float>(1 << shift);
  const int mask = (1 << shift) - 1;
  return corners_within(
      corners, static_cast<float>(whole.edge_m()),
      {part * static_cast<float>(cube.x & mask), part * static_cast<float>(cube.y & mask),
       part * static_cast<float>(cube.z & mask)},
      part);
}

/// Takes a point for the best obstacle if it is hidden and nearer than that.
void try_point(CubeSearch& search, const Eigen::Vector3d& p_B_m, int hint) {
  LinkSearch& link = search.link;
  const Eigen::Vector3f point_B_m = p_B_m.cast<float>();
  const Eigen::Vector3d rounded_B_m = point_B_m.cast<double>();
  if (!search.space.hiding_pixel(rounded_B_m)) return;
  NearPoints point;
  point.count = 1;
  point.p_L_m[0] = in_link(search, rounded_B_m);
  search.mesh.find(hint, 0, point);
  const MeshDistance& found = point.distance[0];
  if (!(found.upper_m < link.best_m)) return;
  link.best_m = found.upper_m;
  link.best_triangle = found.triangle;
  link.best_point_B_m = point_B_m;
  link.best_is_hidden = true;
}

/// Takes the point of the cube that is nearest to the link's triangles near it.
void try_nearest(CubeSearch& search, const Cube& cube, int hint) {
  const Eigen::Vector3d low_m = cube.corner_m();
  const Eigen::Vector3d high_m = low_m.array() + cube.edge_m();
  const Eigen::Vector3f p_L_m = in_link(search, (low_m + high_m) / 2);
  const Eigen::Vector3f nearest_m = search.mesh.nearest_of_leaf(hint, p_L_m);
  const Eigen::Vector3d on_link_m = search.link.X_BL * nearest_m.cast<double>();
  const Eigen::Vector3d point_m = on_link_m.cwiseMax(low_m).cwiseMin(high_m);
  if ((point_m - on_link_m).norm() < search.link.best_m) try_point(search, point_m, hint);
}

/// The best points of a cube that has its turn for the first time.
void try_cube(CubeSearch& search, const Cube& cube, const CubeCorners& corners, int hint) {
  const auto edge_m = static_cast<float>(cube.edge_m());
  if (centre_distance_m(corners, edge_m) < search.link.best_m) {
    try_point(search, cube.corner_m().array() + cube.edge_m() / 2, hint);
  }
  try_nearest(search, cube, hint);
}

/// Makes those children fresh that may be near enough.
void part_cube(Item& item, const Cube& cube, const float (&child_bounds_m)[64], float limit_m,
               int hint, Fresh& fresh) {
  float least_left_m = HUGE_VALF;
  for (std::uint64_t left = item.left; left != 0; left &= left - 1) {
    const int i = __builtin_ctzll(left);
    if (child_bounds_m[i] < limit_m) {
      item.left &= ~(std::uint64_t{1} << i);
      fresh.add(std::max(child_bounds_m[i], item.bound_m), static_cast<std::uint32_t>(hint),
                cube.child(i).key());
    } else {
      least_left_m = std::min(least_left_m, child_bounds_m[i]);
    }
  }
  item.patch = static_cast<std::uint32_t>(hint) | kOpened;
  item.bound_m = std::max(item.bound_m, least_left_m);
}

/// A leaf of the mesh that is near to a cube's centre.
int leaf_near(const CubeSearch& search, const Cube& cube, int hint) {
  NearPoints centre;
  centre.count = 1;
  centre.p_L_m[0] = in_link(search, cube.corner_m().array() + cube.edge_m() / 2);
  search.mesh.find(hint, static_cast<float>(cube.edge_m()) / 2, centre);
  return centre.distance[0].triangle / LinkPatches::kChildren;
}

/// Bounds at a cube's corners, and a leaf that is near to them.
struct KnownCorners {
  CubeCorners corners;
  int hint = 0;
};

/// Raises the item's bound by the field, and asks for the corners themselves only where that leaves
/// it near enough and the field is too coarse for its children. None where it is too far.
std::optional<KnownCorners> look_at_corners(CubeSearch& search, const Cube& cube, Item& item) {
  const LinkSearch& link = search.link;
  const bool is_opened = (item.patch & kOpened) != 0;
  const auto edge_m = static_cast<float>(cube.edge_m());
  KnownCorners out{{}, static_cast<int>(item.patch & ~kOpened)};
  FieldCorners field;
  if (item.way != link.request || cube.level == kGreatestByCorners) {
    field = field_corners(search, cube, item.bound_m, out.hint);
    if (!is_opened) item.bound_m = std::max(item.bound_m, least_distance_m(field.corners, edge_m));
    if (!(item.bound_m < link.limit_m())) return std::nullopt;
  }
  // A grid so much finer than the cube says of its children nearly what its own corners do.
  if (field.grid_edge_m > 0 && 3 * field.grid_edge_m <= edge_m) {
    out.corners = field.corners;
    if (!is_opened) out.hint = leaf_near(search, cube, out.hint);
  } else {
    out.corners = corners_of(search, cube, item.bound_m, out.hint);
  }
  return out;
}

/// A cube of which no child is gone: its bound becomes that of its own corners, and its best points
/// are tried. Returns whether it is to be taken apart now.
bool begin_cube(CubeSearch& search, const Cube& cube, const KnownCorners& known, Item& item,
                Fresh& fresh) {
  const LinkSearch& link = search.link;
  item.patch = static_cast<std::uint32_t>(known.hint);
  if (item.way != link.request) {
    item.way = link.request;
    const auto edge_m = static_cast<float>(cube.edge_m());
    item.bound_m = std::max(item.bound_m, least_distance_m(known.corners, edge_m));
    if (!(item.bound_m < link.limit_m())) return false;
    fresh.again = item.bound_m > link.items.least_bound_m();
    if (fresh.again) return false;
  }
  try_cube(search, cube, known.corners, known.hint);
  return item.bound_m < link.limit_m();
}

void expand(CubeSearch& search, Item& item, Fresh& fresh) {
  LinkSearch& link = search.link;
  const Cube cube = Cube::of_key(item.space);
  if (cube.level > 0) item.left &= search.space.block(cube);
  if (item.left == 0) return;
  const bool is_opened = (item.patch & kOpened) != 0;
  alignas(64) float child_bounds_m[64];
  if (cube.level > kGreatestByCorners) {
    bound_by_patches(search.patches, cube, item.left, link.limit_m(), search.error_m,
                     child_bounds_m);
    const int hint = static_cast<int>(item.patch & ~kOpened);
    return part_cube(item, cube, child_bounds_m, link.limit_m(), hint, fresh);
  }
  const std::optional<KnownCorners> known = look_at_corners(search, cube, item);
  if (!known || (!is_opened && !begin_cube(search, cube, *known, item, fresh))) return;
  if (cube.level == 0) {
    link.given_up_m = std::min(link.given_up_m, item.bound_m);
    return;
  }
  const auto edge_m = static_cast<float>(cube.edge_m());
  bound_child_cubes(known->corners, edge_m, item.left, child_bounds_m);
  part_cube(item, cube, child_bounds_m, link.limit_m(), known->hint, fresh);
}

CubeSearch make_search(const UnknownSpace& space, LinkSearch& link) {
  const float error_m = rounding_m(reach_of_cubes_m(link));
  return {link,
          space,
          link.X_BL.inverse(),
          NearestPointSearch(*link.link, error_m),
          TopPatches(*link.link, link.X_BL),
          error_m};
}

void search_in_cubes(const UnknownSpace& space, int steps, LinkSearch& link) {
  CubeSearch search = make_search(space, link);
  search_best_first(link, steps,
                    [&](Item& item, Fresh& fresh) HWY_ATTR { expand(search, item, fresh); });
}

void try_point_of(const UnknownSpace& space, const Eigen::Vector3f& p_B_m, LinkSearch& link) {
  CubeSearch search = make_search(space, link);
  try_point(search, p_B_m.cast<double>(), 0);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(search_in_cubes);
HWY_EXPORT(try_point_of);

void search_cubes(const UnknownSpace& space, int steps, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(search_in_cubes)(space, steps, search);
}

void try_hidden_point(const UnknownSpace& space, const Eigen::Vector3f& p_B_m, LinkSearch& search) {
  HWY_DYNAMIC_DISPATCH(try_point_of)(space, p_B_m, search);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
