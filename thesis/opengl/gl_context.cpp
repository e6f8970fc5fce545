#include "thesis/opengl/gl_context.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "thesis/opengl/egl.hpp"

namespace berth {
namespace {

/// A context that is current on this thread as long as it is the last one made so.
struct OpenContext {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string renderer;
  bool is_software = false;
};

void make_current(const OpenContext& open) {
  if (!eglMakeCurrent(open.display, EGL_NO_SURFACE, EGL_NO_SURFACE, open.context)) {
    throw GlUnavailable(fmt::format("OpenGL: cannot use the context of {} on this thread: {}",
                                    open.renderer, egl_error_name(eglGetError())));
  }
}

void close(const OpenContext& open) {
  if (eglGetCurrentContext() == open.context) {
    eglMakeCurrent(open.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(open.display, open.context);
}

/// Made current; nothing where the device has no OpenGL 4.5.
std::optional<OpenContext> open_on(const EglDevice& device) {
  OpenContext open{device.display, create_egl_context(device.display), "a new device",
                   device.is_software};
  if (open.context == EGL_NO_CONTEXT) return std::nullopt;
  make_current(open);
  open.renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return open;
}

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return out;
}

bool is_wanted(std::string_view wanted, int number, std::string_view renderer) {
  int wanted_number = 0;
  const auto [end, error] =
      std::from_chars(wanted.data(), wanted.data() + wanted.size(), wanted_number);
  if (error == std::errc() && end == wanted.data() + wanted.size()) return number == wanted_number;
  return lower(renderer).find(lower(wanted)) != std::string::npos;
}

OpenContext open_wanted(std::string_view wanted) {
  std::vector<std::string> seen;
  for (const EglDevice& device : open_egl_devices()) {
    std::optional<OpenContext> open = open_on(device);
    if (!open) continue;
    if (is_wanted(wanted, static_cast<int>(seen.size()), open->renderer)) return *open;
    close(*open);
    seen.push_back(fmt::format("{} ({})", seen.size(), open->renderer));
  }
  if (seen.empty()) {
    throw GlUnavailable(
        "OpenGL: no device of this machine has OpenGL 4.5 core; expected a GPU whose driver has "
        "it, or Mesa's software renderer (package libgl1-mesa-dri)");
  }
  throw GlUnavailable(
      fmt::format("OpenGL: no device \"{}\"; expected the number or a part of the name "
                  "of one of {}",
                  wanted, fmt::join(seen, ", ")));
}

std::string_view gl_error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "another OpenGL error";
  }
}

}  // namespace

struct GlContext::State {
  explicit State(std::string_view device) : open(open_wanted(device)) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(note_message, this);
  }
  ~State() { close(open); }

  static void note_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                           const GLchar* text, const void* state) {
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    auto& messages = static_cast<State*>(const_cast<void*>(state))->messages;
    messages.emplace_back(text, static_cast<std::size_t>(length));
  }

  OpenContext open;
  std::vector<std::string> messages;
};

GlContext::GlContext(std::string_view device) : state_(std::make_unique<State>(device)) {}

GlContext::~GlContext() = default;

const std::string& GlContext::renderer() const { return state_->open.renderer; }

bool GlContext::is_software() const { return state_->open.is_software; }

void GlContext::make_current() { berth::make_current(state_->open); }

void GlContext::check(std::string_view where) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR && state_->messages.empty()) return;
  const std::string name(error == GL_NO_ERROR ? "undefined behaviour" : gl_error_name(error));
  const std::string text = fmt::format("OpenGL: {} on {}: {} {}", where, renderer(), name,
                                       fmt::join(state_->messages, "; "));
  state_->messages.clear();
  throw std::runtime_error(text);
}

std::vector<std::string> gl_devices() {
  std::vector<std::string> names;
  for (const EglDevice& device : open_egl_devices()) {
    const std::optional<OpenContext> open = open_on(device);
    if (!open) continue;
    names.push_back(open->renderer);
    close(*open);
  }
  return names;
}

}  // namespace berth
