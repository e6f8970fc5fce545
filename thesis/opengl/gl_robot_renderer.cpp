#include "thesis/opengl/gl_robot_renderer.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "berth/render/robot_renderer.hpp"
#include "thesis/opengl/gl_tolerance.hpp"

namespace berth {
namespace {

/// kNear_m of robot_triangle.glsl.
constexpr double kNear_m = 1e-4;

/// From a point of frame C to clip coordinates: pixel (u, v)'s centre is at u + 1/2, v + 1/2 of the
/// window, and row 0 of the textures is v = 0.
Eigen::Matrix4f to_clip(const Camera& camera) {
  const double width = camera.width_px;
  const double height = camera.height_px;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2 * camera.fx_px / width;
  clip(0, 2) = 2 * camera.corner_cx_px() / width - 1;
  clip(1, 1) = 2 * camera.fy_px / height;
  clip(1, 2) = 2 * camera.corner_cy_px() / height - 1;
  clip(2, 3) = kNear_m;
  clip(3, 2) = 1;
  return clip.cast<float>();
}

/// `pinhole` of robot_fragment.glsl.
Eigen::Vector4f pinhole(const Camera& camera) {
  return Eigen::Vector4d(camera.corner_cx_px(), camera.corner_cy_px(), 1 / camera.fx_px,
                         1 / camera.fy_px)
      .cast<float>();
}

void require_enlargement(const GlEnlargement& enlargement) {
  if (std::isfinite(enlargement.model_scale) && enlargement.model_scale >= 1 &&
      std::isfinite(enlargement.normal_padding_m) && enlargement.normal_padding_m >= 0)
    return;
  throw std::invalid_argument(
      fmt::format("enlargement of the robot: model_scale {}, normal_padding_m {}; expected a "
                  "finite scale of at least 1 and a finite padding of at least 0",
                  enlargement.model_scale, enlargement.normal_padding_m));
}

}  // namespace

GlRobotRenderer::GlRobotRenderer(const RobotModel& model, const Camera& camera)
    : camera_(checked(camera)),
      mesh_(model),
      framebuffer_(camera.width_px, camera.height_px),
      program_("robot.vert.glsl", "robot.frag.glsl", {}),
      filter_program_("robot.vert.glsl", "filtered_robot.frag.glsl", {}) {
  for (GlProgram* program : {&program_, &filter_program_}) {
    program->set("to_clip_C", to_clip(camera_));
    program->set("pinhole", pinhole(camera_));
  }
}

void GlRobotRenderer::draw(const RobotPose& pose, const Pose& X_BC,
                           const GlEnlargement& enlargement, GlProgram& program) {
  program.set("model_scale", static_cast<float>(enlargement.model_scale));
  program.set("normal_padding_m", static_cast<float>(enlargement.normal_padding_m));
  mesh_.use();
  const Pose X_CB = X_BC.inverse();
  for (const GlRobotMesh::Link& link : mesh_.links()) {
    const Pose X_CL = X_CB * pose.X_BL[link.link_index];
    program.set("X_CL", Eigen::Matrix4f(X_CL.matrix().cast<float>()));
    program.set("centre_L_m", link.centre_L_m);
    program.set("link_id", static_cast<unsigned>(link.id));
    program.use();
    GlRobotMesh::draw(link);
  }
}

void GlRobotRenderer::render(const RobotPose& pose, const Pose& X_BC,
                             const GlEnlargement& enlargement, const GlRobotImage& image) {
  require_finite(X_BC);
  require_enlargement(enlargement);
  framebuffer_.begin({&image.depth_m, &image.link_id});
  image.depth_m.clear();
  image.link_id.clear();
  draw(pose, X_BC, enlargement, program_);
}

void GlRobotRenderer::render_and_filter(const RobotPose& pose, const Pose& X_BC,
                                        const GlEnlargement& enlargement,
                                        const GlTexture& sensor_depth_m, const Tolerance& tolerance,
                                        const GlRobotImage& image,
                                        const GlTexture& filtered_depth_m) {
  require_finite(X_BC);
  require_enlargement(enlargement);
  framebuffer_.begin({&image.depth_m, &image.link_id, &filtered_depth_m});
  image.depth_m.clear();
  image.link_id.clear();
  sensor_depth_m.copy_to(filtered_depth_m);
  filter_program_.read("sensor_depth_m", sensor_depth_m);
  filter_program_.set("tolerance", gl_tolerance(tolerance));
  draw(pose, X_BC, enlargement, filter_program_);
}

}  // namespace berth
