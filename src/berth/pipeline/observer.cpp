#include "berth/pipeline/observer.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {

Observer::Observer(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {
  if (rig.region_meshes()) region_renderer_.emplace(rig.region_meshes(), rig.camera());
}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame) {
  const Camera& camera = rig_.camera();
  if (depth_m.width != camera.width_px || depth_m.height != camera.height_px) {
    throw std::invalid_argument(
        fmt::format("depth image: {} x {} px; expected the camera's {} x {}", depth_m.width,
                    depth_m.height, camera.width_px, camera.height_px));
  }
  forward_kinematics(rig_.model(), at_exposure.position, pose_);
  frame.stamp_s = at_exposure.stamp_s;
  frame.X_BC = rig_.camera_pose(pose_);
  renderer_.render(pose_, frame.X_BC, frame.robot);
  filter(depth_m, frame);
  build_obstacle_tree(frame.obstacles.depth_m, frame.obstacle_tree);
}

void Observer::filter(DepthView depth_m, Frame& frame) {
  const SelfFilterSettings& settings = rig_.settings().self_filter;
  if (!region_renderer_) {
    self_filter(rig_.camera(), depth_m, frame.robot, settings, workspace_, frame.obstacles);
    return;
  }
  region_renderer_->render(pose_, frame.X_BC, region_);
  self_filter(rig_.camera(), depth_m, frame.robot, region_, settings, workspace_, frame.obstacles);
}

}  // namespace berth
