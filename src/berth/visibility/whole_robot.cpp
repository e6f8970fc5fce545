#include "berth/visibility/whole_robot.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "berth/visibility/sight_count.hpp"

namespace berth {
namespace {

/// The sight of the view that knows most: Sight is in that order.
template <class SightIn>
Sight best_sight(std::span<const SeeingCamera> views, const Eigen::Vector3d& p_B_m,
                 const SightIn& sight_in) {
  Sight best = Sight::outside_image;
  for (const SeeingCamera& view : views) {
    best = std::min(best, sight_in(view, view.X_CB * p_B_m));
    if (best == Sight::seen) break;
  }
  return best;
}

SightCount count_on_surface(std::span<const SeeingCamera> views,
                            const std::vector<SurfacePoint>& surface_L, const Pose& X_BL) {
  SightCount count;
  for (const SurfacePoint& point : surface_L) {
    count.add(best_sight(views, X_BL * point.p_L_m, sight_of_robot_point));
  }
  return count;
}

SightCount count_in_ball(std::span<const SeeingCamera> views, const SpacePair& link,
                         const std::vector<SurfacePoint>& surface_L, const Pose& X_BL,
                         const std::vector<Eigen::Vector3d>& unit_ball) {
  SightCount count;
  const double radius_m = link.is_known() ? link.distance_m : link.lower_bound_m;
  if (surface_L.empty() || !(radius_m > 0)) return count;
  const Eigen::Vector3d robot_B_m = link.robot_point_B_m.cast<double>();
  for (std::size_t i = 0; i < unit_ball.size(); ++i) {
    const Eigen::Vector3d centre_B_m =
        link.is_known() ? robot_B_m : X_BL * surface_L[i % surface_L.size()].p_L_m;
    count.add(best_sight(views, centre_B_m + radius_m * unit_ball[i],
                         [](const SeeingCamera& view, const Eigen::Vector3d& p_C_m) {
                           return sight_of_space(view.frame, p_C_m);
                         }));
  }
  return count;
}

}  // namespace

Sight sight_of_robot_point(const SeeingCamera& view, const Eigen::Vector3d& p_C_m) {
  const std::optional<Pixel> pixel = pixel_of(view.frame.camera, p_C_m);
  if (!pixel) return Sight::outside_image;
  const float reading_m = view.sensor_depth_m(pixel->u, pixel->v);
  if (std::isnan(reading_m)) return Sight::no_reading;
  const float least_m = view.frame.tolerance.least_reading_m(static_cast<float>(p_C_m.z()));
  const PixelFate fate = view.frame.obstacles.fate(pixel->u, pixel->v);
  if (is_kept(fate)) {
    const float obstacle_m = view.frame.obstacles.depth_m(pixel->u, pixel->v);
    return obstacle_m < least_m ? Sight::hidden_by_obstacles : Sight::seen;
  }
  if (fate != PixelFate::robot && fate != PixelFate::environment) return Sight::no_reading;
  return reading_m < least_m ? Sight::hidden_by_robot : Sight::seen;
}

bool is_seen(std::span<const SeeingCamera> views, const std::vector<SurfacePoint>& surface_L,
             const Pose& X_BL, double least_share) {
  const double needed = least_share * static_cast<double>(surface_L.size());
  int seen = 0;
  for (const SurfacePoint& point : surface_L) {
    if (seen >= needed) return true;
    seen += best_sight(views, X_BL * point.p_L_m, sight_of_robot_point) == Sight::seen;
  }
  return seen >= needed && !surface_L.empty();
}

void find_whole_robot_visibility(const RobotModel& model, const SamplePoints& points,
                                 const RobotPose& pose, std::span<const SeeingCamera> views,
                                 std::span<const WholeLinkDistance> distances,
                                 std::vector<LinkVisibility>& out) {
  out.resize(points.surface.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Pose& X_BL = pose.X_BL[model.evaluated_links[i]];
    const SightCount space =
        count_in_ball(views, distances[i].nearest, points.surface[i], X_BL, points.unit_ball);
    out[i] = {};
    out[i].id = static_cast<LinkId>(i + 1);
    out[i].surface = count_on_surface(views, points.surface[i], X_BL).shares();
    out[i].space = space.shares();
    out[i].space_unknown = space.unknown_share();
  }
}

}  // namespace berth
