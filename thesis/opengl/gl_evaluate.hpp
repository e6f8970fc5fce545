#pragma once

#include <memory>

#include "thesis/evaluate.hpp"
#include "thesis/opengl/gl_images.hpp"

namespace berth {

/// evaluate() for the methods that run on OpenGL: their shaders, compiled when a method is first
/// asked for, and their memory, taken when an image's size or the number of links is new. It
/// belongs to the context that is current when it is made.
class GlEvaluator {
 public:
  GlEvaluator();
  ~GlEvaluator();
  GlEvaluator(const GlEvaluator&) = delete;
  GlEvaluator& operator=(const GlEvaluator&) = delete;

  /// As evaluate() of distance/, with images that are on the GPU already. Throws
  /// std::invalid_argument for bad settings or a method that does not run on OpenGL.
  void evaluate(Method method, const Camera& camera, const GlRobotImage& robot,
                const GlTexture& obstacle_depth_m, int link_count,
                const ImageDistanceSettings& settings, LinkDistances& out);

  /// The same with images of this program's memory: uploads them first.
  void evaluate(Method method, const ImageRequest& request, LinkDistances& out);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth
