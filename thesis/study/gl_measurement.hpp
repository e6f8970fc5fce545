// The same for the methods that run on OpenGL.
#pragma once

#include <optional>

#include "thesis/opengl/gl_context.hpp"
#include "thesis/opengl/gl_evaluate.hpp"
#include "thesis/study/measurement.hpp"

namespace berth::lab {

/// measure() in one OpenGL context, on the thread that made it.
class GlMeasurer {
 public:
  /// The context has to be current, and to stay longer.
  explicit GlMeasurer(GlContext& context) : context_(context) {}

  /// The time is by the clock on the wall, from images that are on the GPU to the answer in memory:
  /// least_ms() after one run to warm up, which compiles shaders where they are new. The robot
  /// image, which gl_hybrid needs in memory, is read back each time. Throws std::runtime_error
  /// where OpenGL reports an error.
  Measurement measure(const ParameterSet& set, const sim::ImagePair& images,
                      const LinkDistances& truth);

 private:
  GlContext& context_;
  GlEvaluator evaluator_;
  std::optional<GlUploadedImages> uploaded_;
  LinkDistances answer_;
};

}  // namespace berth::lab
