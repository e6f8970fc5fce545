#include "berth/pipeline/prepare_frame.hpp"

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/sensor/phantoms.hpp"

namespace berth {
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
