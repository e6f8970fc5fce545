#include "berth/sensor/beside_robot.hpp"

#include "berth/self_filter/self_filter.hpp"

namespace berth {

const Image<PixelFate>& find_beside_robot(const Camera& camera, DepthView depth_m,
                                          const RobotImage& robot, double clearance_m,
                                          BesideRobotWorkspace& workspace) {
  SelfFilterSettings settings;
  settings.tolerance_m = settings.padding_depth_m = 1e6;  // all depths
  settings.padding_m = clearance_m;
  settings.surface_tolerance_m = 0;
  settings.flying_patch_radius_m = 0;
  workspace.links = robot;
  // Things before environment are to be found, so it must not cover anything.
  take_out_environment(workspace.links);
  self_filter(camera, depth_m, workspace.links, settings, workspace.filter, workspace.left);
  return workspace.left.fate;
}

}  // namespace berth
