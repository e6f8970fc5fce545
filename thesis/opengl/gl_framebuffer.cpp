#include "thesis/opengl/gl_framebuffer.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <stdexcept>

namespace berth {
namespace {

/// OpenGL promises eight.
constexpr std::size_t kMostTargets = 8;

}  // namespace

GlFramebuffer::GlFramebuffer(int width, int height) : width_(width), height_(height) {
  glCreateRenderbuffers(1, &depth_);
  glNamedRenderbufferStorage(depth_, GL_DEPTH_COMPONENT32F, width, height);
  glCreateFramebuffers(1, &name_);
  glNamedFramebufferRenderbuffer(name_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
}

GlFramebuffer::~GlFramebuffer() {
  glDeleteFramebuffers(1, &name_);
  glDeleteRenderbuffers(1, &depth_);
}

void GlFramebuffer::begin(std::initializer_list<const GlTexture*> targets) {
  assert(targets.size() <= kMostTargets);
  std::array<GLenum, kMostTargets> places{};
  GLenum place = GL_COLOR_ATTACHMENT0;
  for (const GlTexture* target : targets) {
    assert(target->width() == width_ && target->height() == height_);
    glNamedFramebufferTexture(name_, place, target->name(), 0);
    places[place - GL_COLOR_ATTACHMENT0] = place;
    ++place;
  }
  // What was drawn on before may be gone.
  for (GLenum rest = place; rest < GL_COLOR_ATTACHMENT0 + kMostTargets; ++rest) {
    glNamedFramebufferTexture(name_, rest, 0, 0);
  }
  glNamedFramebufferDrawBuffers(name_, static_cast<GLsizei>(targets.size()), places.data());
  const GLenum status = glCheckNamedFramebufferStatus(name_, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("OpenGL: cannot draw on images of {} x {} px: status {:#x}; expected a driver "
                    "that draws on {} images of single numbers",
                    width_, height_, status, targets.size()));
  }
  constexpr GLfloat kNothing = 0;
  glClearNamedFramebufferfv(name_, GL_DEPTH, 0, &kNothing);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_);
  glViewport(0, 0, width_, height_);
  // A depth of near / z in floats is as precise far away as it is near.
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
}

}  // namespace berth
