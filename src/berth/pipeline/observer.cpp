#include "berth/pipeline/observer.hpp"

#include <stdexcept>

#include "berth/calibration/frame_displacement.hpp"
#include "berth/pipeline/prepare_frame.hpp"

namespace berth {
namespace {

/// Where nobody gave another way, and the view's settings ask for one.
MeasureDisplacement displacement_of(const View& view, MeasureDisplacement given) {
  if (given || !(view.settings().watch.max_displacement_m > 0)) return given;
  const RobotModel& model = view.robot()->model();
  const FrameDisplacement displacement(model, view.robot()->meshes(), view.camera(),
                                       *model.find_link(view.mount().parent_link),
                                       view.mount().X_PC, view.settings().watch.bias_m);
  return [displacement](DepthView depth_m, const JointState& joints, const std::stop_token& stop) {
    return displacement.measure(depth_m, joints, stop);
  };
}

}  // namespace

Observer::Observer(std::shared_ptr<const View> view, MeasureDisplacement measure)
    : view_(std::move(view)),
      renderer_(view_->robot()->meshes(), view_->camera()),
      watch_(view_->settings().watch, displacement_of(*view_, std::move(measure))) {
  if (view_->region_meshes()) region_renderer_.emplace(view_->region_meshes(), view_->camera());
}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame,
                       FrameTime time) {
  const Camera& camera = view_->camera();
  if (!begin_exposure(view_, depth_m, at_exposure, time, frame)) {
    frame.watch = watch_.pass_over();
    return clear_images(camera, frame);
  }
  renderer_.render(frame.pose, frame.X_BC, frame.robot);
  frame.watch = watch_.look(depth_m, frame.robot, at_exposure);
  filter(depth_m, frame);
  apply_sensor_rules(depth_m, frame.robot, background_, view_->settings().sensor, sensor_,
                     frame.obstacles);
  prepare_frame(depth_m, frame);
}

void Observer::filter(DepthView depth_m, Frame& frame) {
  const SelfFilterSettings& settings = view_->settings().self_filter;
  if (!region_renderer_) {
    self_filter(view_->camera(), depth_m, frame.robot, settings, workspace_, frame.obstacles);
    return;
  }
  region_renderer_->render(frame.pose, frame.X_BC, region_);
  self_filter(view_->camera(), depth_m, frame.robot, region_, settings, workspace_,
              frame.obstacles);
}

void Observer::observe(DepthView depth_m, double stamp_s, const JointBuffer& joints, Frame& frame,
                       double clock_offset_s) {
  const TimeSettings& settings = view_->robot()->settings().time;
  const TimeStatus stamp = clock_.next(stamp_s, settings);
  FrameTime time = joints.at(stamp_s + clock_offset_s, settings.joints, at_exposure_);
  at_exposure_.stamp_s = stamp_s;
  if (stamp != TimeStatus::ok) time.status = stamp;
  observe(depth_m, at_exposure_, frame, time);
}

void Observer::finish_watch(Frame& frame) { frame.watch = watch_.wait(); }

const SensorSettings& Observer::background_settings() const {
  const SensorSettings& settings = view_->settings().sensor;
  if (settings.has_background()) return settings;
  throw std::invalid_argument(
      "sensor.background_frames: 0; expected 1 or more, to learn a background");
}

void Observer::learn_background(DepthView depth_m, const Frame& frame) {
  require_size(view_->camera(), depth_m);
  const SensorSettings& settings = background_settings();
  // Without its robot, or with the robot elsewhere, the image would give the arm for a background.
  if (frame.time.status != TimeStatus::ok || !frame.watch.is_trusted()) return;
  background_.learn(view_->camera(), depth_m, frame.robot, frame.obstacles.fate, settings);
}

DepthImage Observer::background_m() const {
  return background_.learned_m(view_->camera(), background_settings());
}

void Observer::set_background(DepthView depth_m) {
  require_size(view_->camera(), depth_m);
  background_.assign(depth_m, background_settings());
}

}  // namespace berth
