#include "thesis/opengl/egl.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "thesis/opengl/gl_context.hpp"

namespace berth {
namespace {

/// libepoxy ends the program if it does not find a library, so look before it does.
void require_library(const char* what, std::initializer_list<const char*> names,
                     const char* package) {
  for (const char* name : names) {
    if (dlopen(name, RTLD_LAZY | RTLD_LOCAL)) return;
  }
  throw GlUnavailable(
      fmt::format("OpenGL: {} is not installed ({}); expected it from the package {}", what,
                  dlerror(), package));
}

/// One of these.
void require_client_extension(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, name)) return;
  }
  throw GlUnavailable(fmt::format(
      "OpenGL: EGL has no {}; expected it of Mesa (package libegl-mesa0) or the GPU's driver",
      *names.begin()));
}

bool is_software(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions &&
         std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos;
}

}  // namespace

std::vector<EglDevice> open_egl_devices() {
  require_library("EGL", {"libEGL.so.1"}, "libegl1");
  require_library("OpenGL", {"libOpenGL.so.0", "libGL.so.1"}, "libopengl0 or libgl1");
  // A driver may tell the older extension alone, of which enumeration is a part.
  require_client_extension({"EGL_EXT_device_enumeration", "EGL_EXT_device_base"});
  require_client_extension({"EGL_EXT_platform_device"});

  EGLint count = 0;
  eglQueryDevicesEXT(0, nullptr, &count);
  std::vector<EGLDeviceEXT> handles(std::max(count, 0));
  if (count > 0) eglQueryDevicesEXT(count, handles.data(), &count);
  std::vector<EglDevice> devices;
  for (EGLDeviceEXT handle : handles) {
    EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, handle, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) continue;
    devices.push_back({display, is_software(handle)});
  }
  if (devices.empty()) {
    throw GlUnavailable(fmt::format(
        "OpenGL: EGL opens none of its {} devices; expected a GPU with its driver, or Mesa's "
        "software renderer (packages libegl-mesa0 and libgl1-mesa-dri)",
        count));
  }
  std::stable_partition(devices.begin(), devices.end(),
                        [](const EglDevice& device) { return !device.is_software; });
  return devices;
}

EGLContext create_egl_context(EGLDisplay display) {
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

std::string_view egl_error_name(EGLint error) {
  switch (error) {
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_CONTEXT:
      return "EGL_BAD_CONTEXT";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    default:
      return "another EGL error";
  }
}

}  // namespace berth
