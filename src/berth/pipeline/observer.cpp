#include "berth/pipeline/observer.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {

Observer::Observer(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame) {
  const Camera& camera = rig_.camera();
  if (depth_m.width != camera.width_px || depth_m.height != camera.height_px) {
    throw std::invalid_argument(
        fmt::format("depth image: {} x {} px; expected the camera's {} x {}", depth_m.width,
                    depth_m.height, camera.width_px, camera.height_px));
  }
  forward_kinematics(rig_.model(), at_exposure.position, frame.pose);
  frame.stamp_s = at_exposure.stamp_s;
  frame.X_BC = rig_.camera_pose(frame.pose);
  renderer_.render(frame.pose, frame.X_BC, frame.robot);
  self_filter(camera, depth_m, frame.robot, rig_.settings().self_filter, workspace_,
              frame.obstacles);
  build_obstacle_tree(frame.obstacles.depth_m, frame.obstacle_tree);
}

}  // namespace berth
