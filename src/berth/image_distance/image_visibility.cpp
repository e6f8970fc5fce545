#include "berth/image_distance/image_visibility.hpp"

#include <cassert>
#include <span>

#include "berth/visibility/sight_count.hpp"

namespace berth {
namespace {

/// Writes the points that the robot image shows to drawn_C_m.
SightCount count_on_surface(const SeenFrame& frame, const RobotImage& robot, LinkId id,
                            const Pose& X_CL, const std::vector<SurfacePoint>& surface,
                            std::vector<Eigen::Vector3d>& drawn_C_m) {
  drawn_C_m.clear();
  drawn_C_m.reserve(surface.size());
  SightCount count;
  for (const SurfacePoint& point : surface) {
    const LinkPoint in_camera{id, X_CL * point.p_L_m, X_CL.linear() * point.normal_L};
    const SurfaceSight sight = sight_of_surface(frame, robot, in_camera);
    count.add(sight.sight);
    if (sight.is_drawn) drawn_C_m.push_back(in_camera.p_C_m);
  }
  return count;
}

/// Within it of the link nothing stands, says its answer; NaN where it says nothing.
double radius_m(const LinkDistance& link, double range_m) {
  switch (link.status) {
    case LinkStatus::ok:
      return link.distance_m;
    case LinkStatus::none_in_range:
      return range_m;
    case LinkStatus::cut_short:
      return link.lower_bound_m;
    case LinkStatus::not_visible:
    case LinkStatus::stale:
    case LinkStatus::not_seen:
    case LinkStatus::not_observed:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Of balls around the centres, which take turns.
SightCount count_in_balls(const SeenFrame& frame, std::span<const Eigen::Vector3d> centres_C_m,
                          double radius_m, const std::vector<Eigen::Vector3d>& unit_ball) {
  SightCount count;
  if (centres_C_m.empty() || !(radius_m > 0)) return count;
  for (std::size_t i = 0; i < unit_ball.size(); ++i) {
    const Eigen::Vector3d& centre_C_m = centres_C_m[i % centres_C_m.size()];
    count.add(sight_of_space(frame, centre_C_m + radius_m * unit_ball[i]));
  }
  return count;
}

SightCount count_in_space(const SeenFrame& frame, const LinkDistance& link, double range_m,
                          std::span<const Eigen::Vector3d> drawn_C_m,
                          const std::vector<Eigen::Vector3d>& unit_ball) {
  const Eigen::Vector3d robot_C_m = link.robot_point_C_m.cast<double>();
  const auto centres_C_m = link.status == LinkStatus::ok ? std::span(&robot_C_m, 1) : drawn_C_m;
  return count_in_balls(frame, centres_C_m, radius_m(link, range_m), unit_ball);
}

}  // namespace

void find_visibility(const RobotModel& model, const SamplePoints& points, const SeenFrame& frame,
                     const AskedRobot& robot, const LinkDistances& distances, double range_m,
                     VisibilityWorkspace& workspace, std::vector<LinkVisibility>& out) {
  assert(distances.links.size() == points.surface.size());
  const Pose X_CB = robot.X_BC.inverse();
  out.resize(points.surface.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto id = static_cast<LinkId>(i + 1);
    const Pose X_CL = X_CB * robot.pose.X_BL[model.evaluated_links[i]];
    const SightCount surface =
        count_on_surface(frame, robot.image, id, X_CL, points.surface[i], workspace.drawn_C_m);
    const SightCount space =
        count_in_space(frame, distances.links[i], range_m, workspace.drawn_C_m, points.unit_ball);
    out[i].id = id;
    out[i].surface = surface.shares();
    out[i].space = space.shares();
    out[i].space_unknown = space.unknown_share();
  }
}

}  // namespace berth
