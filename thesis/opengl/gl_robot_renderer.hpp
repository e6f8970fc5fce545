#pragma once

#include "berth/robot/kinematics.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "thesis/opengl/gl_framebuffer.hpp"
#include "thesis/opengl/gl_images.hpp"
#include "thesis/opengl/gl_program.hpp"
#include "thesis/opengl/gl_robot_mesh.hpp"

namespace berth {

/// The thesis's own enlargement of the model (Hirt 3.1.1), link by link: first scaled about
/// surface_centre_m, then each vertex moved outward along its normal (vertex_normals).
struct GlEnlargement {
  double model_scale = 1;
  double normal_padding_m = 0;
};

/// RobotRenderer on the GPU: renders one robot into one camera.
class GlRobotRenderer {
 public:
  /// Compiles the shaders and uploads the robot's triangles. Throws std::invalid_argument where the
  /// camera's size or focal lengths are not positive and finite.
  GlRobotRenderer(const RobotModel& model, const Camera& camera);

  /// Draws R and I (Hirt 2.2.1) on `image`, which has the camera's size: at each pixel's centre the
  /// nearest triangle; of two links at the same depth the smaller id; nothing nearer than 0.1 mm.
  /// Outlines are right within 0.01 px. Throws std::invalid_argument where X_BC is not finite or
  /// the enlargement would make links smaller, and then leaves `image` as it was.
  void render(const RobotPose& pose, const Pose& X_BC, const GlEnlargement& enlargement,
              const GlRobotImage& image);
  void render(const RobotPose& pose, const Pose& X_BC, const GlRobotImage& image) {
    render(pose, X_BC, GlEnlargement{}, image);
  }
  /// The thesis's own self filter (Hirt 3.1.1): R and I of the enlarged robot, and in the same pass
  /// `filtered_depth_m`, the sensor's image without the readings on it or behind it. No other rule
  /// of GlSelfFilter applies. All images have the camera's size.
  void render_and_filter(const RobotPose& pose, const Pose& X_BC, const GlEnlargement& enlargement,
                         const GlTexture& sensor_depth_m, const Tolerance& tolerance,
                         const GlRobotImage& image, const GlTexture& filtered_depth_m);

 private:
  void draw(const RobotPose& pose, const Pose& X_BC, const GlEnlargement& enlargement,
            GlProgram& program);

  Camera camera_;
  GlRobotMesh mesh_;
  GlFramebuffer framebuffer_;
  GlProgram program_;
  GlProgram filter_program_;
};

}  // namespace berth
