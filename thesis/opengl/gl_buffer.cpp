#include "thesis/opengl/gl_buffer.hpp"

#include <epoxy/gl.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

GLbitfield map_flags(GlMemory memory) {
  constexpr GLbitfield kStaysMapped = GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
  switch (memory) {
    case GlMemory::device:
      return 0;
    case GlMemory::upload:
      return GL_MAP_WRITE_BIT | kStaysMapped;
    case GlMemory::read_back:
      return GL_MAP_READ_BIT | kStaysMapped;
  }
  return 0;
}

}  // namespace

GlBuffer::GlBuffer(std::size_t bytes, GlMemory memory) : bytes_(bytes) {
  // OpenGL has no buffers of size 0.
  const auto size = static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 4));
  const GLbitfield flags = map_flags(memory);
  glCreateBuffers(1, &name_);
  glNamedBufferStorage(name_, size, nullptr, flags);
  if (flags != 0) mapped_ = glMapNamedBufferRange(name_, 0, size, flags);
  if (flags != 0 && !mapped_) throw std::runtime_error("OpenGL: cannot map a buffer");
}

GlBuffer::~GlBuffer() {
  if (name_ != 0) glDeleteBuffers(1, &name_);
}

void GlBuffer::fill(std::uint32_t number) {
  glClearNamedBufferData(name_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &number);
}

void GlBuffer::copy_to(GlBuffer& target, std::size_t bytes) const {
  glCopyNamedBufferSubData(name_, target.name_, 0, 0, static_cast<GLsizeiptr>(bytes));
}

void take_at_least(std::size_t bytes, GlBuffer& buffer, GlMemory memory) {
  if (buffer.name() == 0 || buffer.bytes() < bytes) buffer = {bytes, memory};
}

GlFence::~GlFence() {
  if (sync_) glDeleteSync(static_cast<GLsync>(sync_));
}

void GlFence::set() {
  if (sync_) glDeleteSync(static_cast<GLsync>(sync_));
  sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void GlFence::wait() {
  if (!sync_) return;
  constexpr GLuint64 kTimeoutNs = 10'000'000'000;
  const GLenum reached =
      glClientWaitSync(static_cast<GLsync>(sync_), GL_SYNC_FLUSH_COMMANDS_BIT, kTimeoutNs);
  if (reached != GL_ALREADY_SIGNALED && reached != GL_CONDITION_SATISFIED) {
    throw std::runtime_error("OpenGL: the GPU did not answer within 10 s");
  }
}

}  // namespace berth
