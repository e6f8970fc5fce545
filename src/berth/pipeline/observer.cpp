#include "berth/pipeline/observer.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {
namespace {

void require_size(const Camera& camera, DepthView depth_m) {
  if (depth_m.width == camera.width_px && depth_m.height == camera.height_px) return;
  throw std::invalid_argument(fmt::format("depth image: {} x {} px; expected the camera's {} x {}",
                                          depth_m.width, depth_m.height, camera.width_px,
                                          camera.height_px));
}

}  // namespace

Observer::Observer(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame) {
  const Camera& camera = rig_.camera();
  const RigSettings& settings = rig_.settings();
  require_size(camera, depth_m);
  forward_kinematics(rig_.model(), at_exposure.position, pose_);
  frame.stamp_s = at_exposure.stamp_s;
  frame.X_BC = rig_.camera_pose(pose_);
  renderer_.render(pose_, frame.X_BC, frame.robot);
  self_filter(camera, depth_m, frame.robot, settings.self_filter, workspace_, frame.obstacles);
  apply_sensor_rules(depth_m, frame.robot, background_, settings.sensor, sensor_, frame.obstacles);
  build_obstacle_tree(frame.obstacles.depth_m, frame.obstacle_tree);
}

void Observer::learn_background(DepthView depth_m, const Frame& frame) {
  require_size(rig_.camera(), depth_m);
  const SensorSettings& settings = rig_.settings().sensor;
  if (settings.background_frames == 0) {
    throw std::invalid_argument(
        "sensor.background_frames: 0; expected 1 or more, to learn a background");
  }
  background_.learn(rig_.camera(), depth_m, frame.robot, frame.obstacles.fate, settings);
}

}  // namespace berth
