#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth {

/// An enlarged robot, whose outline in the image is the robot-shaped region of surveillance
/// (Hirt 3.1.1). Each evaluated link is `scale` times as large in every direction, about the centre
/// of its own surface (surface_centre_m); it covers the link itself if that is convex. Environment
/// is left out.
RobotModel robot_region(const RobotModel& model, double scale);

}  // namespace berth
