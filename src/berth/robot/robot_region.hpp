#pragma once

#include "berth/robot/robot_model.hpp"

namespace berth {

/// The robot whose silhouette is the robot-shaped region of surveillance (Hirt 3.1.1): each
/// evaluated link `scale` times as large in every dimension, about the centre of its own surface
/// (surface_centre_m), so that it holds the link wherever that is convex. Scenery is ignored in it.
RobotModel robot_region(const RobotModel& model, double scale);

}  // namespace berth
