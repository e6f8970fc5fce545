#include "berth/image_distance/opengl/gl_frame.hpp"

#include <optional>

#include "berth/image_distance/opengl/gl_frame_images.hpp"
#include "berth/pipeline/environment_back.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/prepare_frame.hpp"

namespace berth {

GlFrame::GlFrame(const Camera& camera) : images(std::make_unique<GlFrameImages>(camera)) {}
GlFrame::~GlFrame() = default;
GlFrame::GlFrame(GlFrame&&) noexcept = default;
GlFrame& GlFrame::operator=(GlFrame&&) noexcept = default;

void read_back(const GlFrame& frame, Frame& out, FrameUse use) {
  static_cast<Exposure&>(out) = frame;
  if (frame.time.status != TimeStatus::ok) return clear_images(frame.view->camera(), out);
  read_back(frame.images->robot, out.robot);
  read_back(frame.images->obstacles, out.obstacles);
  DepthImage sensor_depth_m;
  read_back(frame.images->sensor_depth_m, sensor_depth_m);
  std::optional<EnvironmentBack> drawing;
  EnvironmentSurfaces environment;
  if (use == FrameUse::any_query) {
    drawing.emplace(out.view->robot()->model(), out.view->camera());
    environment = drawing->at(out.pose, out.X_BC);
  }
  prepare_frame(sensor_depth_m, environment, use, out);
}

}  // namespace berth
