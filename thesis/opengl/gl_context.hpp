// An OpenGL context without a window, a display or an X server.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace berth {

/// OpenGL cannot be had here; what() says what is missing and what to install.
class GlUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An OpenGL 4.5 core context of its own (EGL without a surface). It belongs to the thread that
/// made it, and so do all objects that are made while it is current; they have to go before it.
class GlContext {
 public:
  /// `device`: the number of a device in gl_devices(), or a part of its name, in any case; empty
  /// takes the first that gives OpenGL 4.5, hardware before software. Makes the context current.
  /// Throws GlUnavailable where EGL, OpenGL or the device cannot be had; berth itself needs none of
  /// them.
  explicit GlContext(std::string_view device = {});
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// As the driver names it: "NVIDIA H200/PCIe/SSE2", "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const;

  /// Whether the processor does the work, as Mesa's llvmpipe has it: its times are none of a GPU.
  bool is_software() const;

  /// For a thread that has several contexts.
  void make_current();

  /// Throws std::runtime_error, with the driver's messages and `where`, if a call since the last
  /// check failed.
  void check(std::string_view where);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The renderers of all devices that give OpenGL 4.5, in the order of their numbers. Throws
/// GlUnavailable where EGL cannot be had.
std::vector<std::string> gl_devices();

}  // namespace berth
