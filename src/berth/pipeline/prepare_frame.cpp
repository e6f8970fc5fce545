#include "berth/pipeline/prepare_frame.hpp"

#include "berth/pipeline/view.hpp"

namespace berth {
namespace {

bool is_blind(const ObstacleImage& obstacles) {
  const std::int64_t pixels = std::int64_t{obstacles.fate.width()} * obstacles.fate.height();
  const std::int64_t without =
      obstacles.count_of(PixelFate::no_reading) + obstacles.count_of(PixelFate::hole);
  return static_cast<double>(pixels - without) < kLeastReadings * static_cast<double>(pixels);
}

void prepare_for_mesh(DepthView sensor_depth_m, Frame& frame) {
  const Camera& camera = frame.view->camera();
  const SpaceSettings& settings = frame.view->settings().space;
  build_view_space(camera, sensor_depth_m, frame.obstacles, settings, frame.space);
  if (frame.view->robot()->settings().distance.mean_direction) {
    build_reading_tiles(camera, frame.obstacles.depth_m, frame.reading_tiles);
  }
  frame.is_blind = is_blind(frame.obstacles);
  frame.has_doubtful_space = !frame.doubtful.extent.empty();
  if (frame.has_doubtful_space) {
    build_reading_space(camera, frame.doubtful.depth_m, settings, frame.doubtful_space);
  }
}

}  // namespace

void prepare_frame(DepthView sensor_depth_m, Frame& frame) {
  const EvaluationSettings& settings = frame.view->robot()->settings();
  if (settings.visibility) {
    find_doubtful(sensor_depth_m, frame.obstacles, frame.doubtful);
  } else {
    clear_doubtful(sensor_depth_m.width, sensor_depth_m.height, frame.doubtful);
  }
  if (settings.method == Method::mesh) return prepare_for_mesh(sensor_depth_m, frame);
  frame.searchable.build(frame.obstacles.depth_m);
  if (!frame.doubtful.extent.empty()) frame.doubtful.searchable.build(frame.doubtful.depth_m);
}

}  // namespace berth
