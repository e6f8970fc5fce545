#include "berth/pipeline/exposure.hpp"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>

#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

bool begin_exposure(const std::shared_ptr<const MountedCamera>& mounted, DepthView depth_m,
                    const JointState& at_exposure, FrameTime time, const PlaceAtExposure& place,
                    Exposure& out) {
  require_size(mounted->camera(), depth_m);
  static std::atomic<std::uint64_t> exposures{0};
  out.mounted = mounted;
  out.number = ++exposures;
  out.stamp_s = at_exposure.stamp_s;
  out.time = time;
  out.watch = {};
  out.joints.stamp_s = at_exposure.stamp_s;
  out.joints.position.clear();
  if (time.status != TimeStatus::ok) {
    out.X_PC = out.X_BC = out.X_WB = unset_pose();
    out.pose.X_BL.clear();
    return false;
  }
  forward_kinematics(mounted->robot()->model(), at_exposure.position, out.pose);
  out.joints.position = at_exposure.position;
  out.X_PC = place.X_PC.value_or(mounted->mount().X_PC);
  out.X_BC = mounted->camera_pose(out.pose, out.X_PC);
  out.X_WB = place.X_WB;
  return true;
}

void require_size(const Camera& camera, DepthView depth_m) {
  if (depth_m.width == camera.width_px && depth_m.height == camera.height_px) return;
  throw std::invalid_argument(fmt::format("depth image: {} x {} px; expected the camera's {} x {}",
                                          depth_m.width, depth_m.height, camera.width_px,
                                          camera.height_px));
}

}  // namespace berth
