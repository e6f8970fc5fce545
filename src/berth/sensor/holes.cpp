#include "berth/sensor/holes.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

#include "berth/sensor/background.hpp"

namespace berth {
namespace {

/// Any, since the robot covers all depths.
constexpr float kLost_m = 1;

/// Marks the pixels without a reading that the camera could read. False: there are none.
bool find_lost(DepthView sensor_depth_m, const RobotImage& robot, const KnownPlace& place,
               const SensorSettings& settings, DepthImage& lost_m) {
  const Background* const background =
      place.background && place.background->is_of(sensor_depth_m.width, sensor_depth_m.height)
          ? place.background
          : nullptr;
  if (!background && !place.always_reads) return false;
  lost_m.resize(sensor_depth_m.width, sensor_depth_m.height, kNoDepth);
  std::atomic<bool> has_any = false;
  tbb::parallel_for(0, sensor_depth_m.height, [&](int v) {
    bool has_lost = false;
    for (int u = 0; u < sensor_depth_m.width; ++u) {
      if (!std::isnan(sensor_depth_m(u, v))) continue;
      const bool is_lost = (place.always_reads && robot.link_id(u, v) == kNoLink) ||
                           (background && !std::isnan(background->depth_m(u, v, settings)));
      if (is_lost) lost_m(u, v) = kLost_m;
      has_lost = has_lost || is_lost;
    }
    if (has_lost) has_any = true;
  });
  return has_any;
}

}  // namespace

void find_holes(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                const KnownPlace& place, const SensorSettings& settings, HolesWorkspace& workspace,
                ObstacleImage& out) {
  if (!find_lost(sensor_depth_m, robot, place, settings, workspace.lost_m)) return;
  const Image<PixelFate>& beside =
      find_beside_robot(camera, workspace.lost_m, robot, kRobotShadow_m, workspace.beside_robot);
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    for (int u = 0; u < out.fate.width(); ++u) {
      if (beside(u, v) == PixelFate::obstacle) out.fate(u, v) = PixelFate::hole;
    }
  });
}

}  // namespace berth
