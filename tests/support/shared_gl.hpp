// One OpenGL context for all tests of a program.
#pragma once

#include <string>

#include "thesis/opengl/gl_context.hpp"
#include "thesis/opengl/gl_evaluate.hpp"

namespace berth::testing {

struct SharedGl {
  GlContext context;
  GlEvaluator evaluator;
};

/// Made at the first call, for the thread that calls; null where OpenGL cannot be had.
SharedGl* shared_gl();
/// Why shared_gl() is null.
const std::string& why_no_gl();

}  // namespace berth::testing
