#include "berth/pipeline/observer.hpp"

#include <stdexcept>

namespace berth {

Observer::Observer(std::shared_ptr<const View> view)
    : view_(std::move(view)), renderer_(view_->robot()->meshes(), view_->camera()) {
  if (view_->region_meshes()) region_renderer_.emplace(view_->region_meshes(), view_->camera());
}

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame,
                       FrameTime time) {
  const Camera& camera = view_->camera();
  if (!begin_exposure(view_, depth_m, at_exposure, time, frame)) return clear_images(camera, frame);
  renderer_.render(frame.pose, frame.X_BC, frame.robot);
  filter(depth_m, frame);
  apply_sensor_rules(depth_m, frame.robot, background_, view_->settings().sensor, sensor_,
                     frame.obstacles);
  frame.searchable.build(frame.obstacles.depth_m);
  if (view_->robot()->settings().visibility) {
