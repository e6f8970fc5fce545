// Inside scene/ only.
#pragma once

#include <array>
#include <memory>

#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/view.hpp"
#include "berth/scene/gl_backend.hpp"

namespace berth {

/// One camera's frames from depth image to answer, whatever they are computed on.
class FramePipeline {
 public:
  virtual ~FramePipeline() = default;

  virtual void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) = 0;
  /// The rest is about the last image. At the joint angles of its exposure:
  virtual const Answer& ask() = 0;
  virtual const Exposure& exposure() const = 0;
  /// Whatever its frames say from now on, the camera is implausible.
  void distrust() { is_distrusted_ = true; }
  virtual std::array<std::int64_t, kPixelFateCount> fate_counts() = 0;
  /// The images in this program's memory; read back from the GPU at each call. Nothing writes to it
  /// while somebody holds it.
  virtual std::shared_ptr<const Frame> frame() = 0;
  /// Takes these images as background, where the view's settings ask for one.
  virtual void learn_background(DepthView, const Frame&) {}
  /// Begins with this one.
  virtual void set_background(DepthView) {}

 protected:
  /// For each frame, once it is observed.
  void mark(Exposure& exposure) const { exposure.watch.is_implausible |= is_distrusted_; }

 private:
  bool is_distrusted_ = false;
};

/// Observes on the CPU; asks on `gl` if the robot's method runs there.
std::unique_ptr<FramePipeline> make_cpu_pipeline(const std::shared_ptr<const View>& view,
                                                 GlBackend* gl);

}  // namespace berth
