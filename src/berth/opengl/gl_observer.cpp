#include "berth/opengl/gl_observer.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/robot/robot_region.hpp"

namespace berth {
namespace {

void require_no_sensor_rules(const SensorSettings& sensor) {
  const std::string_view key = sensor.first_rule();
  if (key.empty()) return;
  throw std::invalid_argument(
      fmt::format("sensor.{}: runs on the CPU alone; expected it off on OpenGL", key));
}

void require_no_watch(const WatchSettings& watch) {
  if (!watch.is_on()) return;
  throw std::invalid_argument(
      "watch: a camera is watched on the CPU alone; expected max_seen_through and "
      "max_displacement_m to be 0 on OpenGL");
}

}  // namespace

GlObserver::GlObserver(std::shared_ptr<const View> view)
    : view_(std::move(view)),
      upload_(view_->camera().width_px, view_->camera().height_px),
      renderer_(view_->robot()->model(), view_->camera()),
      region_(view_->camera().width_px, view_->camera().height_px) {
  require_no_sensor_rules(view_->settings().sensor);
  require_no_watch(view_->settings().watch);
  const double scale = view_->settings().self_filter.robot_region_scale;
  if (scale == 0) return;
  region_renderer_.emplace(robot_region(view_->robot()->model(), scale), view_->camera());
}

void GlObserver::observe(DepthView depth_m, const JointState& at_exposure, GlFrame& frame,
                         FrameTime time) {
  has_images_ = begin_exposure(view_, depth_m, at_exposure, time, frame);
  if (!has_images_) return;
  upload_.send(depth_m, frame.sensor_depth_m);
  renderer_.render(frame.pose, frame.X_BC, frame.robot);
  filter(frame);
}

void GlObserver::filter(GlFrame& frame) {
  const SelfFilterSettings& settings = view_->settings().self_filter;
  if (!region_renderer_) {
    filter_.filter(view_->camera(), frame.sensor_depth_m, frame.robot, settings, frame.obstacles);
    return;
  }
  region_renderer_->render(frame.pose, frame.X_BC, region_);
  filter_.filter(view_->camera(), frame.sensor_depth_m, frame.robot, region_.link_id, settings,
                 frame.obstacles);
}

std::array<std::int64_t, kPixelFateCount> GlObserver::fate_counts() {
  if (has_images_) return filter_.count();
  std::array<std::int64_t, kPixelFateCount> none{};
  none[static_cast<std::size_t>(PixelFate::no_reading)] =
      std::int64_t{view_->camera().width_px} * view_->camera().height_px;
  return none;
}

}  // namespace berth
