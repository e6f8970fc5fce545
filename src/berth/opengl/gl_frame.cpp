#include "berth/opengl/gl_frame.hpp"

#include "berth/pipeline/prepare_frame.hpp"
#include "berth/pipeline/view.hpp"

namespace berth {

void read_back(const GlFrame& frame, Frame& out) {
  static_cast<Exposure&>(out) = frame;
  if (frame.time.status != TimeStatus::ok) return clear_images(frame.view->camera(), out);
  read_back(frame.robot, out.robot);
  read_back(frame.obstacles, out.obstacles);
  DepthImage sensor_depth_m;
  read_back(frame.sensor_depth_m, sensor_depth_m);
  prepare_frame(sensor_depth_m, out);
}

}  // namespace berth
