#pragma once

#include <array>
#include <optional>

#include "berth/opengl/gl_robot_renderer.hpp"
#include "berth/opengl/gl_self_filter.hpp"
#include "berth/opengl/gl_frame.hpp"
#include "berth/pipeline/view.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// Observer on OpenGL: the depth image goes to the GPU, and the frame stays there. It belongs to
/// the context that is current when it is made, and to its thread.
class GlObserver {
 public:
  /// Throws std::invalid_argument where a rule of the view's SensorSettings is on, or its watch: they
  /// run on the CPU alone.
  explicit GlObserver(std::shared_ptr<const View> view);

  /// As Observer::observe. `frame` was made for the view's camera.
  void observe(DepthView depth_m, const JointState& at_exposure, GlFrame& frame,
               FrameTime time = {});

  /// Pixels of each PixelFate of the last frame.
  std::array<std::int64_t, kPixelFateCount> fate_counts();

 private:
  void filter(GlFrame& frame);

  std::shared_ptr<const View> view_;
  GlUpload upload_;
  GlRobotRenderer renderer_;
  /// Of the robot-shaped region, where there is one.
  std::optional<GlRobotRenderer> region_renderer_;
  GlRobotImage region_;
  GlSelfFilter filter_;
  bool has_images_ = false;
};

}  // namespace berth
