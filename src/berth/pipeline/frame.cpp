#include "berth/pipeline/frame.hpp"

#include <fmt/format.h>

#include <atomic>
#include <stdexcept>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/sensor/phantoms.hpp"

namespace berth {

bool begin_exposure(const std::shared_ptr<const MountedCamera>& mounted, DepthView depth_m,
                    const JointState& at_exposure, FrameTime time, const PlaceAtExposure& place,
                    Exposure& out) {
  require_size(mounted->camera(), depth_m);
  static std::atomic<std::uint64_t> exposures{0};
  out.mounted = mounted;
  out.number = ++exposures;
  out.stamp_s = at_exposure.stamp_s;
  out.time = time;
  out.watch = {};
  out.joints.stamp_s = at_exposure.stamp_s;
  out.joints.position.clear();
  if (time.status != TimeStatus::ok) {
    out.X_PC = out.X_BC = out.X_WB = unset_pose();
    out.pose.X_BL.clear();
    return false;
  }
  forward_kinematics(mounted->robot()->model(), at_exposure.position, out.pose);
  out.joints.position = at_exposure.position;
  out.X_PC = place.X_PC.value_or(mounted->mount().X_PC);
  out.X_BC = mounted->camera_pose(out.pose, out.X_PC);
  out.X_WB = place.X_WB;
  return true;
}

void require_size(const Camera& camera, DepthView depth_m) {
  if (depth_m.width == camera.width_px && depth_m.height == camera.height_px) return;
  throw std::invalid_argument(fmt::format("depth image: {} x {} px; expected the camera's {} x {}",
                                          depth_m.width, depth_m.height, camera.width_px,
                                          camera.height_px));
}

Frame::Frame() : space(std::make_unique<FrameSpace>()) {}
Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(Frame&&) noexcept = default;

void clear_images(const Camera& camera, Frame& frame) {
  const int width = camera.width_px, height = camera.height_px;
  frame.robot.depth_m.resize(width, height, kNoDepth);
  frame.robot.link_id.resize(width, height, kNoLink);
  frame.robot.extent = {};
  frame.obstacles.depth_m.resize(width, height, kNoDepth);
  frame.obstacles.fate.resize(width, height, PixelFate::no_reading);
  frame.obstacles.count = {};
  frame.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)] = width * height;
  frame.tells_unread = false;
  frame.unread_share = std::numeric_limits<double>::quiet_NaN();
  clear_rejected(width, height, frame.space->rejected);
  clear_space(*frame.space);
}

namespace {

bool is_blind(const ObstacleImage& obstacles) {
  const std::int64_t pixels = std::int64_t{obstacles.fate.width()} * obstacles.fate.height();
  const std::int64_t without =
      obstacles.count_of(PixelFate::no_reading) + obstacles.count_of(PixelFate::hole);
  return static_cast<double>(pixels - without) < kLeastReadOfImage * static_cast<double>(pixels);
}

void prepare_space(DepthView sensor_depth_m, const EnvironmentSurfaces& environment, Frame& frame) {
  const Camera& camera = frame.mounted->camera();
  const SpaceSettings& settings = frame.mounted->settings().space;
  build_camera_space(camera, sensor_depth_m, frame.obstacles, environment, settings,
                     frame.space->seen);
  if (frame.mounted->robot()->settings().distance.mean_direction) {
    build_reading_tiles(camera, frame.obstacles.depth_m, frame.space->reading_tiles);
  }
  frame.space->has_rejected_space = !frame.space->rejected.pixels.empty();
  if (frame.space->has_rejected_space) {
    build_reading_space(camera, frame.space->rejected.depth_m, settings,
                        frame.space->rejected_space);
  }
}

}  // namespace

void prepare_frame(DepthView sensor_depth_m, const EnvironmentSurfaces& environment, Frame& frame) {
  const EvaluationSettings& settings = frame.mounted->robot()->settings();
  drop_phantoms(frame.mounted->camera(), sensor_depth_m,
                frame.mounted->settings().sensor.phantom_radius_m, frame.space->phantoms,
                frame.obstacles);
  if (settings.visibility) {
    find_rejected(sensor_depth_m, frame.obstacles, frame.space->rejected);
  } else {
    clear_rejected(sensor_depth_m.width, sensor_depth_m.height, frame.space->rejected);
  }
  frame.is_blind = is_blind(frame.obstacles);
  prepare_space(sensor_depth_m, environment, frame);
}

}  // namespace berth
