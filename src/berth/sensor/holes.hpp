#pragma once

#include <vector>

#include "berth/sensor/background.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The memory of find_holes().
struct HolesWorkspace {
  /// A depth at each pixel that may be a hole.
  DepthImage lost_m;
  BesideRobotWorkspace beside_robot;
  /// Of each link, how many more of its pixels have a reading than are lost.
  std::vector<int> read_surplus;
};

/// Gives the fate `hole` to pixels without a reading that the camera could read if nothing were
/// there: the empty cell has one (KnownPlace::background), or KnownPlace::always_reads says so and
/// the model, robot or environment, does not cover it. Not within kRobotShadow_m beside the
/// evaluated links. On them, whatever the cell shows there, where a ball of 4 cm fits into what the
/// links lost; not on a link without readings in half of its pixels, which is black itself. F stays
/// as it is.
void find_holes(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                const KnownPlace& place, const SensorSettings& settings, HolesWorkspace& workspace,
                ObstacleImage& out);

}  // namespace berth
