#pragma once

#include <array>
#include <memory>
#include <string>

#include "apps/support/backend_arguments.hpp"
#include "berth/opengl/gl_context.hpp"
#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/rig.hpp"

namespace berth {

/// A context, if the backend or the method needs one. Throws GlUnavailable where there is none.
std::unique_ptr<GlContext> open_context(const app::BackendArguments& where, Method method);

/// One camera's frames from depth image to answer, on the backend that was asked for.
class FramePipeline {
 public:
  virtual ~FramePipeline() = default;

  virtual void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) = 0;
  /// The rest is about the last image. At the joint angles of its exposure:
  virtual const Answer& ask() = 0;
  virtual const Exposure& exposure() const = 0;
  virtual std::array<std::int64_t, kPixelFateCount> fate_counts() = 0;
  /// The images in this program's memory; read back from the GPU at each call.
  virtual const Frame& frame() = 0;
  /// Whose background may be learned; null on OpenGL, where there is none.
  virtual Observer* cpu_observer() = 0;
};

/// The rig has to outlive it, and so has the context that it needs. Throws std::invalid_argument
/// where the rig's settings do not go with the backend.
std::unique_ptr<FramePipeline> make_frame_pipeline(const Rig& rig, app::Backend backend);

}  // namespace berth
