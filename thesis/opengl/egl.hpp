// EGL, found at run time: the devices of this machine, and a context on one of them.
#pragma once

#include <epoxy/egl.h>

#include <string_view>
#include <vector>

namespace berth {

struct EglDevice {
  EGLDisplay display;
  bool is_software;
};

/// All devices whose display can be opened, hardware first. A display stays open until the program
/// ends: EGL has one for all contexts of a device, and closing it would take it from the others.
/// Throws GlUnavailable if there is none.
std::vector<EglDevice> open_egl_devices();

/// An OpenGL 4.5 core context without a surface, not current; EGL_NO_CONTEXT if the device has
/// none.
EGLContext create_egl_context(EGLDisplay display);

/// "EGL_BAD_ALLOC" and so on.
std::string_view egl_error_name(EGLint error);

}  // namespace berth
