#pragma once

#include <memory>
#include <optional>

#include "berth/pipeline/robot.hpp"
#include "berth/types/joint_state.hpp"
#include "thesis/image_result.hpp"
#include "thesis/opengl/gl_frame.hpp"

namespace berth {

class ImageMethod;

/// A method that runs on OpenGL, for images of this program's memory: they are uploaded for each
/// request. Throws std::invalid_argument for another method. It belongs to the context that is
/// current when it is made, and to its thread.
std::unique_ptr<ImageMethod> make_gl_method(Method method);

/// ImageQuery on OpenGL, whose frames stay there. What comes back from the GPU is the answer.
/// Shaders are compiled and the robot is uploaded at the first request that needs them. It belongs
/// to the context that is current when it is made, and to its thread.
class GlImageQuery {
 public:
  /// Throws std::invalid_argument if the method does not run on OpenGL, and for bad settings.
  GlImageQuery(std::shared_ptr<const Robot> robot, Method method,
               const ImageSettings& settings = {});
  ~GlImageQuery();

  /// As those of ImageQuery, without a count of pixel fates.
  const ImageResult& ask(const GlFrame& frame, std::optional<double> now_s = {});
  const ImageResult& ask(const GlFrame& frame, const JointState& joints,
                         std::optional<double> now_s = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
