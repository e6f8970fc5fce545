#include "berth/pipeline/exposure.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/pipeline/rig.hpp"

namespace berth {

bool begin_exposure(const Rig& rig, DepthView depth_m, const JointState& at_exposure,
                    FrameTime time, Exposure& out) {
  require_size(rig.camera(), depth_m);
  out.stamp_s = at_exposure.stamp_s;
  out.time = time;
  if (time.status != TimeStatus::ok) {
    out.X_BC = unset_pose();
    out.pose.X_BL.clear();
    return false;
  }
  forward_kinematics(rig.model(), at_exposure.position, out.pose);
  out.X_BC = rig.camera_pose(out.pose);
  return true;
}

void require_size(const Camera& camera, DepthView depth_m) {
  if (depth_m.width == camera.width_px && depth_m.height == camera.height_px) return;
  throw std::invalid_argument(fmt::format("depth image: {} x {} px; expected the camera's {} x {}",
                                          depth_m.width, depth_m.height, camera.width_px,
                                          camera.height_px));
}

}  // namespace berth
