#include "berth/opengl/gl_frame.hpp"

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/view.hpp"

namespace berth {

void read_back(const GlFrame& frame, Frame& out) {
  static_cast<Exposure&>(out) = frame;
  if (frame.time.status != TimeStatus::ok) return clear_images(frame.view->camera(), out);
  read_back(frame.robot, out.robot);
  read_back(frame.obstacles, out.obstacles);
  out.searchable.build(out.obstacles.depth_m);
  DepthImage sensor_depth_m;
  read_back(frame.sensor_depth_m, sensor_depth_m);
  find_doubtful(sensor_depth_m, out.obstacles, out.doubtful);
  if (out.view->robot()->settings().method != Method::mesh) return;
  ObstacleImage as_obstacle;
  find_frame_space(sensor_depth_m, as_obstacle, out);
}

}  // namespace berth
