// A view, its cells and planes before patches as the search for one link sees them.
#if defined(BERTH_MESH_SEARCHED_VIEW_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_SEARCHED_VIEW_INL_HPP
#undef BERTH_MESH_SEARCHED_VIEW_INL_HPP
#else
#define BERTH_MESH_SEARCHED_VIEW_INL_HPP
#endif

#include <algorithm>
#include <cmath>

#include "berth/distance/leaf-inl.hpp"
#include "berth/distance/link_search.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// A view as one link's search sees it.
struct SearchedCamera {
  const CameraSpace* space;
  SearchFrame frame;
  /// Pixel border u, at u - 1/2, has the slope x / z = u per_column + first_column.
  float per_column, first_column, per_row, first_row;
  /// Behind it is nothing within LinkSearch::known_range_m().
  float far_m;
};

inline SearchedCamera make_view(const FreeingCamera& view, const LinkSearch& search) {
  const Camera& camera = view.space->camera;
  const Pose X_CL = view.X_CB * search.X_BL;
  const PatchLevel& top = search.link->levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  const double radius_m = top.half_height_m[0] + top.radius_m[0];
  const double known_m = radius_m + search.known_range_m();
  const double reach_m = centre_L_m.norm() + X_CL.translation().norm() + known_m;
  SearchedCamera out;
  out.space = view.space;
  out.frame = make_frame(X_CL, static_cast<float>(reach_m));
  out.per_column = static_cast<float>(1 / camera.fx_px);
  out.first_column = static_cast<float>((-0.5 - camera.cx_px) / camera.fx_px);
  out.per_row = static_cast<float>(1 / camera.fy_px);
  out.first_row = static_cast<float>((-0.5 - camera.cy_px) / camera.fy_px);
  out.far_m = static_cast<float>((X_CL * centre_L_m).z() + known_m);
  return out;
}

struct Chunk {
  float a0, a1, b0, b1, d, e;
};

struct ViewSearch {
  LinkSearch& link;
  bool to_shadow;
  SearchedCamera views[UnknownSpace::kMostViews];
};

HWY_INLINE float end_of(const ViewSearch& search, const SearchedCamera& view, float hi_m) {
  if (search.to_shadow) return view.far_m;
  return std::min(hi_m + static_cast<float>(view.space->settings.surface_thickness_m), view.far_m);
}

inline Chunk chunk_of(const ViewSearch& search, const ImageCell& cell) {
  const SearchedCamera& view = search.views[cell.view];
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

/// All of a patch has n . x >= along_m.
struct Plane {
  Heading n;
  float along_m;
};

/// The plane that lies before a patch as it is seen from a chunk. A leaf's triangles are farther
/// behind than its cylinder.
HWY_INLINE Plane plane_towards(const ViewSearch& search, const SearchedCamera& view,
                               std::uint32_t patch, const Chunk& chunk) {
  const Patches hull = broadcast_patch(search.link.link->levels[level_of(patch)], index_of(patch),
                                       view.frame.motion);
  const Vectors n = direction(hull.centre, nearest_in<2>(broadcast(chunk), hull.centre)).n;
  const Heading heading{hn::GetLane(n.x.v), hn::GetLane(n.y.v), hn::GetLane(n.z.v)};
  const float along_m = level_of(patch) == 0
                            ? least_along(search.link, view.frame, index_of(patch), heading)
                            : hn::GetLane((dot(hull.centre, n) - reach_along(hull, n)).v);
  return {heading, along_m - view.frame.error_m};
}

HWY_INLINE Lanes bound_of(const Plane& plane, const Chunks& chunks) {
  return Lanes(plane.along_m) - reach_of(chunks, broadcast(plane.n));
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
