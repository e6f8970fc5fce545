#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "berth/self_filter/flying_patches.hpp"
#include "berth/self_filter/grown_robot.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/self_filter/surface_things.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Scratch of self_filter, one for each caller at a time.
struct SelfFilterWorkspace {
  Outline outline;
  GrownRobot padding;
  SurfaceThingsWorkspace surface_things;
  FlyingPatchWorkspace flying_patches;
  /// Of each row of tiles.
  std::vector<std::array<std::int64_t, kPixelFateCount>> counts;
};

/// Removes the robot from the sensor's image (Hirt 2.2.1), on all threads that TBB gives; the
/// result does not depend on their number. `robot` is rendered at the pose that it had when the
/// image was exposed; both images have the camera's size; `sensor_depth_m` holds NaN where there is
/// no reading. Writes F, and for each pixel its fate, to `out`, whose memory it reuses. Throws
/// std::invalid_argument if settings.robot_region_scale asks for a region.
void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                 ObstacleImage& out);

/// The same, and then ignores what is left where `region`, the image of robot_region() at the same
/// pose, shows nothing: last of all rules, since flying patches have to see where a piece goes.
/// Throws std::invalid_argument if settings.robot_region_scale asks for no region.
void self_filter(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                 const RobotImage& region, const SelfFilterSettings& settings,
                 SelfFilterWorkspace& workspace, ObstacleImage& out);

/// The rules that look at pieces of readings, the last ones but the region: things on surfaces,
/// then flying patches. `out` holds what the rules before have left, on whatever processor.
void judge_pieces(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, SelfFilterWorkspace& workspace,
                  ObstacleImage& out);

/// Leaves the links that are evaluated; what environment hides of them stays hidden.
inline void take_out_environment(RobotImage& robot) {
  for (std::size_t i = 0; i < robot.link_id.pixels().size(); ++i) {
    if (robot.link_id.pixels()[i] != kEnvironmentLink) continue;
    robot.link_id.pixels()[i] = kNoLink;
    robot.depth_m.pixels()[i] = kNoDepth;
  }
}

}  // namespace berth
