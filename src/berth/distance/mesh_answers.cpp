#include "berth/distance/link_search.hpp"

#include <algorithm>

namespace berth::mesh {
namespace {

void set_points(const Eigen::Vector3d& robot_B_m, const Eigen::Vector3d& obstacle_B_m,
                SpacePair& pair) {
  pair.robot_point_B_m = robot_B_m.cast<float>();
  pair.obstacle_point_B_m = obstacle_B_m.cast<float>();
  pair.distance_m = static_cast<float>(
      (pair.obstacle_point_B_m.cast<double>() - pair.robot_point_B_m.cast<double>()).norm());
}

/// The best pair was a triangle and all that a pixel measured, or also what that hides.
void set_pixel_pair(const UnknownSpace& space, const LinkSearch& search, SpacePair& pair) {
  const ImageCell cell = ImageCell::of_key(search.best_pixel);
  const FreeingCamera& view =
      search.best_is_hidden ? space.shadow_view() : space.views()[cell.view];
  const Camera& camera = view.space->camera;
  const double near_m = view.space->obstacle_depth_m(cell.u, cell.v);
  const double surface_end_m = near_m + view.space->settings.surface_thickness_m;
  const Pose X_CL = view.X_CB * search.X_BL;
  // Far enough to hold all within the range: the pair found was nearer.
  const double far_m =
      search.best_is_hidden ? surface_end_m + X_CL.translation().norm() + 100 : surface_end_m;
  Eigen::Vector3d corners_m[8];
  for (int i = 0; i < 8; ++i) {
    const double z = i & 4 ? far_m : near_m;
    corners_m[i] = {z * (cell.u + (i & 1 ? 0.5 : -0.5) - camera.cx_px) / camera.fx_px,
                    z * (cell.v + (i & 2 ? 0.5 : -0.5) - camera.cy_px) / camera.fy_px, z};
  }
  const ConvexPair found = triangle_pair(search, X_CL, search.best_triangle, corners_m);
  set_points(view.X_BC * found.a_m, view.X_BC * found.b_m, pair);
  // The shadow's pixel may begin before the reading, or without one.
  const bool is_reading =
      space.views()[cell.view].space->obstacle_depth_m(cell.u, cell.v) == near_m;
  const bool is_hidden = search.best_is_hidden && (found.b_m.z() > surface_end_m || !is_reading);
  pair.obstacle_is = is_hidden ? ObstacleKind::unknown : ObstacleKind::occupied;
  pair.camera = cell.view;
  pair.obstacle_pixel = {cell.u, cell.v};
}

/// The best pair was a triangle and a point of unknown space.
void set_hidden_pair(const UnknownSpace& space, const LinkSearch& search, SpacePair& pair) {
  const Eigen::Vector3d point_B_m = search.best_point_B_m.cast<double>();
  const auto hiding = space.hiding_pixel(point_B_m);
  if (!hiding) return;
  const ConvexPair found =
      triangle_pair(search, search.X_BL, search.best_triangle, {&point_B_m, 1});
  set_points(found.a_m, point_B_m, pair);
  pair.obstacle_is = hiding->pixel.u < 0 ? ObstacleKind::unobserved : ObstacleKind::unknown;
  pair.camera = hiding->view;
  pair.obstacle_pixel = hiding->pixel;
}

}  // namespace

ConvexPair triangle_pair(const LinkSearch& search, const Pose& X_FL, int triangle,
                         std::span<const Eigen::Vector3d> body_corners_m) {
  Eigen::Vector3d corners_m[3];
  const auto& from_m = search.link->corners_m;
  for (int i = 0; i < 3; ++i) {
    corners_m[i] = X_FL * Eigen::Vector3d(from_m[3 * i][triangle], from_m[3 * i + 1][triangle],
                                          from_m[3 * i + 2][triangle]);
  }
  return closest_points(corners_m, body_corners_m);
}

SpacePair pair_of(const UnknownSpace& space, bool is_shadow, LinkSearch& search) {
  SpacePair pair;
  pair.lower_bound_m = search.lower_bound_m();
  if (!search.is_known()) return pair;
  if (search.best_is_hidden && !is_shadow) {
    set_hidden_pair(space, search, pair);
  } else {
    set_pixel_pair(space, search, pair);
  }
  search.robot_point_L_m = search.X_BL.inverse() * pair.robot_point_B_m.cast<double>();
  search.obstacle_point_B_m = pair.obstacle_point_B_m.cast<double>();
  if (!pair.is_known()) search.best_triangle = -1;
  return pair;
}

void reconcile(WholeLinkDistance& link) {
  SpacePair& nearest = link.nearest;
  SpacePair& occupied = link.occupied;
  if (occupied.is_known() && !(nearest.distance_m <= occupied.distance_m)) {
    const float lower_bound_m = nearest.lower_bound_m;
    nearest = occupied;
    nearest.lower_bound_m = lower_bound_m;
  }
  occupied.lower_bound_m = std::max(occupied.lower_bound_m, nearest.lower_bound_m);
  for (SpacePair* pair : {&nearest, &occupied}) {
    if (pair->is_known()) pair->lower_bound_m = std::min(pair->lower_bound_m, pair->distance_m);
  }
}

}  // namespace berth::mesh
