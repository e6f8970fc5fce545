// In place of gl_backend.cpp where berth is built without OpenGL.
#include <stdexcept>

#include "thesis/gl_backend.hpp"

namespace berth {

std::unique_ptr<GlBackend> open_gl_backend(const std::string&) {
  throw std::runtime_error(
      "OpenGL: this berth was built without it; expected the backend cpu and a method that runs on "
      "the CPU, or a build with BERTH_OPENGL=ON");
}

}  // namespace berth
