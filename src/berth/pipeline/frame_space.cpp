#include "berth/pipeline/frame_space.hpp"

#include "berth/pipeline/view.hpp"

namespace berth {

void find_frame_space(DepthView sensor_depth_m, ObstacleImage& as_obstacle, Frame& frame) {
  const Camera& camera = frame.view->camera();
  const SpaceSettings& settings = frame.view->settings().space;
  build_view_space(camera, sensor_depth_m, frame.obstacles, settings, frame.space);
  if (frame.view->robot()->settings().distance.mean_direction) {
    build_reading_tiles(camera, frame.obstacles.depth_m, frame.reading_tiles);
  }
  const std::int64_t pixels = std::int64_t{camera.width_px} * camera.height_px;
  const std::int64_t without = frame.obstacles.count_of(PixelFate::no_reading) +
                               frame.obstacles.count_of(PixelFate::hole);
  frame.is_blind =
      static_cast<double>(pixels - without) < kLeastReadings * static_cast<double>(pixels);
  frame.has_doubtful_space = !frame.doubtful.extent.empty();
  if (!frame.has_doubtful_space) return;
  as_obstacle.depth_m = frame.doubtful.depth_m;
  as_obstacle.fate.resize(camera.width_px, camera.height_px, PixelFate::obstacle);
  build_view_space(camera, sensor_depth_m, as_obstacle, settings, frame.doubtful_space);
}

}  // namespace berth
