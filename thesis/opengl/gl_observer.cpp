#include "thesis/opengl/gl_observer.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "berth/robot/surface.hpp"
#include "thesis/opengl/gl_frame_images.hpp"
#include "thesis/opengl/gl_robot_renderer.hpp"
#include "thesis/opengl/gl_self_filter.hpp"

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

void require_nothing_soft(const RobotModel& model) {
  if (model.soft_bodies.empty()) return;
  throw std::invalid_argument(
      "attached: what is soft is taken out on the CPU alone; expected nothing soft on OpenGL");
}

}  // namespace

struct GlObserver::Parts {
  explicit Parts(std::shared_ptr<const MountedCamera> of)
      : mounted(std::move(of)),
        upload(mounted->camera().width_px, mounted->camera().height_px),
        renderer(mounted->robot()->model(), mounted->camera()),
        region(mounted->camera().width_px, mounted->camera().height_px) {}

  void apply_filter(GlFrame& frame);

  std::shared_ptr<const MountedCamera> mounted;
  GlUpload upload;
  GlRobotRenderer renderer;
  /// Of the robot-shaped region, where there is one.
  std::optional<GlRobotRenderer> region_renderer;
  GlRobotImage region;
  GlSelfFilter filter;
  bool has_images = false;
};

GlObserver::GlObserver(std::shared_ptr<const MountedCamera> mounted)
    : parts_(std::make_unique<Parts>(std::move(mounted))) {
  const CameraSettings& settings = parts_->mounted->settings();
  require_no_sensor_rules(settings.sensor);
  require_no_watch(settings.watch);
  require_nothing_soft(parts_->mounted->robot()->model());
  const double scale = settings.self_filter.robot_region_scale;
  if (scale == 0) return;
  parts_->region_renderer.emplace(robot_region(parts_->mounted->robot()->model(), scale),
                                  parts_->mounted->camera());
}

GlObserver::~GlObserver() = default;

void GlObserver::observe(DepthView depth_m, const JointState& at_exposure, GlFrame& frame,
                         FrameTime time) {
  parts_->has_images = begin_exposure(parts_->mounted, depth_m, at_exposure, time, {}, frame);
  if (!parts_->has_images) return;
  parts_->upload.send(depth_m, frame.images->sensor_depth_m);
  parts_->renderer.render(frame.pose, frame.X_BC, frame.images->robot);
  parts_->apply_filter(frame);
}

void GlObserver::Parts::apply_filter(GlFrame& frame) {
  const SelfFilterSettings& settings = mounted->settings().self_filter;
  if (!region_renderer) {
    filter.filter(mounted->camera(), frame.images->sensor_depth_m, frame.images->robot, settings,
                  frame.images->obstacles);
    return;
  }
  region_renderer->render(frame.pose, frame.X_BC, region);
  filter.filter(mounted->camera(), frame.images->sensor_depth_m, frame.images->robot,
                region.link_id, settings, frame.images->obstacles);
}

std::array<std::int64_t, kPixelFateCount> GlObserver::fate_counts() {
  if (parts_->has_images) return parts_->filter.count();
  std::array<std::int64_t, kPixelFateCount> none{};
  none[static_cast<std::size_t>(PixelFate::no_reading)] =
      std::int64_t{parts_->mounted->camera().width_px} * parts_->mounted->camera().height_px;
  return none;
}

}  // namespace berth
