#pragma once

#include <string>

namespace berth {

/// Where images are rendered and filtered.
enum class Backend { cpu, opengl };

/// The backend of a run, and the device that OpenGL takes there.
struct BackendChoice {
  Backend backend = Backend::cpu;
  /// As GlContext takes it; also for methods that run on OpenGL whatever the backend is.
  std::string gl_device = {};
};

}  // namespace berth
