// What several cameras know of the whole robot, without a picture of it at the pose asked for.
#pragma once

#include <span>
#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/types/closest_pair.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/visibility/line_of_sight.hpp"
#include "berth/visibility/sample_points.hpp"

namespace berth {

/// Whether at least this share of the link's sample points is seen by at least one view.
bool is_seen(std::span<const SeeingCamera> views, const PointLanes& surface_L, const Pose& X_BL,
             double least_share);

/// Of the ball that a link's answer speaks of, as LinkVisibility::space, the share that lies in no
/// view's image and in no guarded box.
double unobserved_share(std::span<const SeeingCamera> views, std::span<const GuardedBox> guarded,
                        const SpacePair& nearest, const PointLanes& surface_L, const Pose& X_BL,
                        const PointLanes& unit_ball);

/// Writes the shares of surface and space of out[i], the link with the id i + 1: a point counts by
/// the view that knows most of it, in the order of Sight. `distances` are those
/// of the whole robot at `pose`. The ball of a link without a distance lies around the points of
/// its surface in turn, with its lower bound for a radius. Allocates nothing once `out` has grown.
void find_whole_robot_visibility(const RobotModel& model, const SamplePoints& points,
                                 const RobotPose& pose, std::span<const SeeingCamera> views,
                                 std::span<const WholeLinkDistance> distances,
                                 std::vector<LinkVisibility>& out);

}  // namespace berth
