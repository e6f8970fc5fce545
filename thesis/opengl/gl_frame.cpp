#include "thesis/opengl/gl_frame.hpp"

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/robot_drawing.hpp"
#include "thesis/opengl/gl_frame_images.hpp"

namespace berth {

GlFrame::GlFrame(const Camera& camera) : images(std::make_unique<GlFrameImages>(camera)) {}
GlFrame::~GlFrame() = default;
GlFrame::GlFrame(GlFrame&&) noexcept = default;
GlFrame& GlFrame::operator=(GlFrame&&) noexcept = default;

void read_back(const GlFrame& frame, Frame& out) {
  static_cast<Exposure&>(out) = frame;
  if (frame.time.status != TimeStatus::ok) return clear_images(frame.mounted->camera(), out);
  read_back(frame.images->robot, out.robot);
  read_back(frame.images->obstacles, out.obstacles);
  DepthImage sensor_depth_m;
  read_back(frame.images->sensor_depth_m, sensor_depth_m);
  EnvironmentBack drawing(out.mounted->robot()->model(), out.mounted->camera());
  prepare_frame(sensor_depth_m, drawing.at(out.pose, out.X_BC), out);
}

}  // namespace berth
