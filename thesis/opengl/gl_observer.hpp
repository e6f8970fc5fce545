#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/obstacle_image.hpp"
#include "thesis/opengl/gl_frame.hpp"

namespace berth {

/// Observer on OpenGL: the depth image goes to the GPU, and the frame stays there. It belongs to
/// the context that is current when it is made, and to its thread.
class GlObserver {
 public:
  /// Throws std::invalid_argument where a rule of the view's SensorSettings is on, or its watch:
  /// they run on the CPU alone.
  explicit GlObserver(std::shared_ptr<const MountedCamera> mounted);
  ~GlObserver();

  /// As Observer::observe. `frame` was made for the view's camera.
  void observe(DepthView depth_m, const JointState& at_exposure, GlFrame& frame,
               FrameTime time = {});

  /// Pixels of each PixelFate of the last frame.
  std::array<std::int64_t, kPixelFateCount> fate_counts();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
