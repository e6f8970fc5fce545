#include "berth/pipeline/observer.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {

namespace {

/// Nothing of the image before may stay under a new stamp.
void clear(const Camera& camera, Frame& frame) {
  const int width = camera.width_px, height = camera.height_px;
  frame.X_BC = unset_pose();
  frame.pose.X_BL.clear();
  frame.robot.depth_m.resize(width, height, kNoDepth);
  frame.robot.link_id.resize(width, height, kNoLink);
  frame.robot.extent = {};
  frame.obstacles.depth_m.resize(width, height, kNoDepth);
  frame.obstacles.fate.resize(width, height, PixelFate::no_reading);
  frame.obstacles.count = {};
  frame.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)] = width * height;
  build_obstacle_tree(frame.obstacles.depth_m, frame.obstacle_tree);
}

}  // namespace

Observer::Observer(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame,
                       FrameTime time) {
  const Camera& camera = rig_.camera();
  if (depth_m.width != camera.width_px || depth_m.height != camera.height_px) {
    throw std::invalid_argument(
        fmt::format("depth image: {} x {} px; expected the camera's {} x {}", depth_m.width,
                    depth_m.height, camera.width_px, camera.height_px));
  }
  frame.stamp_s = at_exposure.stamp_s;
  frame.time = time;
  if (time.status != TimeStatus::ok) return clear(camera, frame);
  forward_kinematics(rig_.model(), at_exposure.position, frame.pose);
  frame.X_BC = rig_.camera_pose(frame.pose);
  renderer_.render(frame.pose, frame.X_BC, frame.robot);
  self_filter(camera, depth_m, frame.robot, rig_.settings().self_filter, workspace_,
              frame.obstacles);
  build_obstacle_tree(frame.obstacles.depth_m, frame.obstacle_tree);
}

void Observer::observe(DepthView depth_m, double stamp_s, const JointBuffer& joints, Frame& frame) {
  const TimeSettings& settings = rig_.settings().time;
  const TimeStatus stamp = clock_.next(stamp_s, settings);
  FrameTime time = joints.at(stamp_s, settings.joints, at_exposure_);
  if (stamp != TimeStatus::ok) time.status = stamp;
  observe(depth_m, at_exposure_, frame, time);
}

}  // namespace berth
