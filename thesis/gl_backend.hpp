// What runs on OpenGL, behind one wall: a build without OpenGL has the wall alone.
#pragma once

#include <memory>
#include <string>

#include "berth/scene/open_scene.hpp"
#include "thesis/backend.hpp"
#include "thesis/image_camera.hpp"
#include "thesis/image_method.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// One OpenGL context, current in this thread while it lives.
class GlBackend {
 public:
  virtual ~GlBackend() = default;

  virtual std::string renderer() const = 0;
  /// Throws std::runtime_error where OpenGL reported an error since the last call.
  virtual void check(const std::string& what) = 0;
  /// Observes on OpenGL, and asks there if the method runs there. Throws std::invalid_argument
  /// where the camera's settings ask for what runs on the CPU alone.
  virtual std::unique_ptr<ImageCamera> make_camera(const OpenScene& scene, const OpenCamera& camera,
                                                   Method method,
                                                   const ImageSettings& settings) = 0;
  /// A method that runs on OpenGL, for images of this program's memory.
  virtual std::unique_ptr<ImageMethod> make_method(Method method) = 0;
};

/// Throws std::runtime_error where the device, OpenGL or berth's own part for it is not there.
/// `device` is as GlContext takes it.
std::unique_ptr<GlBackend> open_gl_backend(const std::string& device);

/// The same where this method, or the choice, needs OpenGL; else null.
inline std::unique_ptr<GlBackend> needed_gl_backend(Method method, const BackendChoice& where) {
  const bool is_needed = where.backend == Backend::opengl || runs_on_opengl(method);
  return is_needed ? open_gl_backend(where.gl_device) : nullptr;
}

}  // namespace berth
