#include "berth/pipeline/observer.hpp"

#include <optional>
#include <stdexcept>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/robot_drawing.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/drop_soft.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/sensor_rules.hpp"
#include "berth/watch/frame_displacement.hpp"
#include "berth/watch/pose_watch.hpp"

namespace berth {
namespace {

/// Where nobody gave another way, and the view's settings ask for one. `view` has to outlive it.
MeasureDisplacement displacement_of(const MountedCamera& mounted, MeasureDisplacement given) {
  if (given || !(mounted.settings().watch.max_displacement_m > 0)) return given;
  return [&mounted](DepthView depth_m, const JointState& joints, const Pose& X_PC,
                    const std::stop_token& stop) {
    const RobotModel& model = mounted.robot()->model();
    const FrameDisplacement displacement(model, mounted.robot()->meshes(), mounted.camera(),
                                         *model.find_link(mounted.mount().parent_link), X_PC,
                                         mounted.settings().watch.bias_m);
    return displacement.measure(depth_m, joints, stop);
  };
}

/// Pixels without a reading that do not show the robot.
std::int64_t count_unread(const RobotImage& robot, const ObstacleImage& obstacles) {
  const PixelRect extent = clip(robot.extent, obstacles.fate.width(), obstacles.fate.height());
  std::int64_t count = obstacles.count_of(PixelFate::no_reading);
  for (int v = extent.v_begin; v < extent.v_end; ++v) {
    const LinkId* const id = robot.link_id.row(v);
    const PixelFate* const fate = obstacles.fate.row(v);
    int of_robot = 0;  // so that the compiler makes vectors of it
    for (int u = extent.u_begin; u < extent.u_end; ++u) {
      of_robot += int(id[u] != kNoLink) & int(id[u] != kEnvironmentLink) &
                  int(fate[u] == PixelFate::no_reading);
    }
    count -= of_robot;
  }
  return count;
}

}  // namespace

/// Scratch memory, and what is remembered from image to image.
struct Observer::Parts {
  Parts(std::shared_ptr<const MountedCamera> of, MeasureDisplacement measure,
        const CameraWatch& before)
      : mounted(std::move(of)),
        drawing(*mounted->robot(), mounted->camera()),
        environment_back(mounted->robot()->model(), mounted->camera()),
        watch(mounted->settings().watch, displacement_of(*mounted, std::move(measure)), before) {
    if (mounted->region_meshes())
      region_renderer.emplace(mounted->region_meshes(), mounted->camera());
  }

  void filter(DepthView depth_m, Frame& frame);
  KnownPlace known_place(DepthView environment_m) const;
  void tell_unread(Frame& frame) const;
  const SensorSettings& background_settings() const;

  std::shared_ptr<const MountedCamera> mounted;
  RobotDrawing drawing;
  EnvironmentBack environment_back;
  /// Of the robot-shaped region, where there is one.
  std::optional<RobotRenderer> region_renderer;
  RobotImage region;
  SelfFilterWorkspace workspace;
  std::vector<PosedSoftBody> soft;
  SensorWorkspace sensor;
  Background background;
  FrameClock clock;
  PoseWatch watch;
  JointState at_exposure;
};

Observer::Observer(std::shared_ptr<const MountedCamera> mounted, MeasureDisplacement measure,
                   const CameraWatch& before)
    : parts_(std::make_unique<Parts>(std::move(mounted), std::move(measure), before)) {}

Observer::~Observer() = default;
Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;

void Observer::observe(DepthView depth_m, const JointState& at_exposure, Frame& frame,
                       FrameTime time, const PlaceAtExposure& place) {
  const Camera& camera = parts_->mounted->camera();
  if (!begin_exposure(parts_->mounted, depth_m, at_exposure, time, place, frame)) {
    frame.watch = parts_->watch.pass_over();
    return clear_images(camera, frame);
  }
  parts_->drawing.draw(frame.pose, frame.X_BC, frame.robot);
  frame.watch = parts_->watch.look(depth_m, frame.robot, at_exposure, frame.X_PC);
  parts_->filter(depth_m, frame);
  const CameraSettings& settings = parts_->mounted->settings();
  const EnvironmentSurfaces environment = parts_->environment_back.at(frame.pose, frame.X_BC);
  apply_sensor_rules(camera, depth_m, frame.robot, parts_->known_place(environment.front_m),
                     settings.sensor, parts_->sensor, frame.obstacles);
  parts_->tell_unread(frame);
  prepare_frame(depth_m, environment, frame);
}

KnownPlace Observer::Parts::known_place(DepthView environment_m) const {
  const CameraSettings& settings = mounted->settings();
  return {.background = &background,
          .environment_m = environment_m,
          .tolerance = tolerance_of(settings.self_filter),
          .always_reads = settings.space.no_reading == NoReading::hides};
}

void Observer::Parts::tell_unread(Frame& frame) const {
  const Camera& camera = mounted->camera();
  const NoReading no_reading = mounted->settings().space.no_reading;
  const bool finds_holes =
      no_reading == NoReading::hides || (mounted->settings().sensor.has_background() &&
                                         background.is_of(camera.width_px, camera.height_px));
  const std::int64_t unread = finds_holes ? frame.obstacles.count_of(PixelFate::hole)
                                          : count_unread(frame.robot, frame.obstacles);
  frame.tells_unread = finds_holes || no_reading == NoReading::free;
  frame.unread_share =
      static_cast<double>(unread) / static_cast<double>(frame.obstacles.fate.pixels().size());
}

void Observer::Parts::filter(DepthView depth_m, Frame& frame) {
  const SelfFilterSettings& settings = mounted->settings().self_filter;
  if (region_renderer) {
    region_renderer->render(frame.pose, frame.X_BC, region);
    self_filter(mounted->camera(), depth_m, frame.robot, region, settings, workspace,
                frame.obstacles);
  } else {
    self_filter(mounted->camera(), depth_m, frame.robot, settings, workspace, frame.obstacles);
  }
  pose_soft_bodies(mounted->robot()->model(), frame.pose, frame.X_BC, soft);
  drop_soft(mounted->camera(), soft, frame.obstacles);
}

void Observer::observe(DepthView depth_m, double stamp_s, const JointBuffer& joints, Frame& frame,
                       double clock_offset_s, const std::optional<PlaceAtExposure>& place) {
  const TimeSettings& settings = parts_->mounted->robot()->settings().time;
  const TimeStatus stamp = parts_->clock.next(stamp_s);
  FrameTime time = joints.at(stamp_s + clock_offset_s, settings.joints, parts_->at_exposure);
  parts_->at_exposure.stamp_s = stamp_s;
  if (stamp != TimeStatus::ok) {
    time.status = stamp;
  } else if (!place && time.status == TimeStatus::ok) {
    time.status = TimeStatus::stale_pose;
  }
  observe(depth_m, parts_->at_exposure, frame, time, place.value_or(PlaceAtExposure{}));
}

void Observer::finish_watch(Frame& frame) { frame.watch = parts_->watch.wait(); }

const SensorSettings& Observer::Parts::background_settings() const {
  const SensorSettings& settings = mounted->settings().sensor;
  if (settings.has_background()) return settings;
  throw std::invalid_argument(
      "sensor.background_frames: 0; expected 1 or more, to learn a background");
}

void Observer::learn_background(DepthView depth_m, const Frame& frame) {
  require_size(parts_->mounted->camera(), depth_m);
  const SensorSettings& settings = parts_->background_settings();
  // Without its robot, or with the robot elsewhere, the image would give the arm for a background.
  if (frame.time.status != TimeStatus::ok || !frame.watch.is_trusted()) return;
  parts_->background.learn(parts_->mounted->camera(), depth_m, frame.robot, frame.obstacles.fate,
                           settings);
}

DepthImage Observer::background_m() const {
  return parts_->background.learned_m(parts_->mounted->camera(), parts_->background_settings());
}

void Observer::set_background(DepthView depth_m) {
  require_size(parts_->mounted->camera(), depth_m);
  parts_->background.assign(depth_m, parts_->background_settings());
}

}  // namespace berth
