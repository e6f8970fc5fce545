#include "berth/visibility/whole_robot.hpp"

#include "berth/visibility/line_of_sight.hpp"

namespace berth {
namespace {

PlacedPoints on_surface(const PointLanes& surface_L, const Pose& X_BL) {
  PlacedPoints points;
  points.count = surface_L.count;
  points.origin_B_m = X_BL.translation().cast<float>();
  points.parts[0] = {&surface_L, X_BL.linear().cast<float>()};
  return points;
}

/// Around the link's closest point; of a link without one around the points of its surface in turn.
/// None where there is no ball.
PlacedPoints points_in_ball(const SpacePair& link, const PointLanes& surface_L, const Pose& X_BL,
                            const PointLanes& unit_ball) {
  const float radius_m = link.is_known() ? link.distance_m : link.lower_bound_m;
  if (surface_L.count == 0 || !(radius_m > 0)) return {};
  PlacedPoints points = on_surface(surface_L, X_BL);
  if (link.is_known()) {
    points.origin_B_m = link.robot_point_B_m;
    points.parts[0] = {};
  }
  points.count = unit_ball.count;
  points.parts[1] = {&unit_ball, radius_m * Eigen::Matrix3f::Identity()};
  return points;
}

}  // namespace

bool is_seen(std::span<const SeeingCamera> views, const PointLanes& surface_L, const Pose& X_BL,
             double least_share) {
  const SightCount count = count_surface_sights(views, on_surface(surface_L, X_BL));
  return count.sum() > 0 && count.count(Sight::seen) >= least_share * count.sum();
}

double unobserved_share(std::span<const SeeingCamera> views, std::span<const GuardedBox> guarded,
                        const SpacePair& nearest, const PointLanes& surface_L, const Pose& X_BL,
                        const PointLanes& unit_ball) {
  const PlacedPoints points = points_in_ball(nearest, surface_L, X_BL, unit_ball);
  return points.count == 0 ? 0 : count_unobserved(views, guarded, points) / double(points.count);
}

void find_whole_robot_visibility(const RobotModel& model, const SamplePoints& points,
                                 const RobotPose& pose, std::span<const SeeingCamera> views,
                                 std::span<const WholeLinkDistance> distances,
                                 std::vector<LinkVisibility>& out) {
  out.resize(points.surface_lanes.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const PointLanes& surface_L = points.surface_lanes[i];
    const Pose& X_BL = pose.X_BL[model.evaluated_links[i]];
    const SightCount space = count_space_sights(
        views, points_in_ball(distances[i].nearest, surface_L, X_BL, points.unit_ball_lanes));
    out[i] = {};
    out[i].id = static_cast<LinkId>(i + 1);
    out[i].surface = count_surface_sights(views, on_surface(surface_L, X_BL)).shares();
    out[i].space = space.shares();
    out[i].space_unknown = space.unknown_share();
  }
}

}  // namespace berth
