// Inside scene/ only.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <stdexcept>

#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/scene/gl_backend.hpp"

namespace berth {

/// One camera's frames, whatever they are computed on.
class FramePipeline {
 public:
  virtual ~FramePipeline() = default;

  virtual void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) = 0;
  /// The rest is about the last image. Its result at the joint angles of its exposure; only where
  /// the scene's method compares images.
  virtual const Result& ask() {
    throw std::logic_error("cameras that are joined are not asked alone");
  }
  /// Tells in the last frame and those after it what somebody else found out of whether the camera
  /// stands where it should; null: it does. Nothing waits for the pipeline's own watch from then
  /// on.
  virtual void tell_watch(const CameraWatch* found) {
    is_told_ = true;
    found_ = found ? std::optional(*found) : std::nullopt;
  }
  /// Whatever its frames say from now on, the camera is implausible.
  void distrust() { is_distrusted_ = true; }
  virtual std::array<std::int64_t, kPixelFateCount> fate_counts() = 0;
  /// The images in this program's memory; read back from the GPU at each call. Nothing writes to it
  /// while somebody holds it.
  virtual std::shared_ptr<const Frame> frame() = 0;
  /// The same for who holds the newest frame of each camera; null where that would cost a reading
  /// back that no result needs.
  virtual std::shared_ptr<const Frame> kept() { return frame(); }
  /// Takes these images as background, where the view's settings ask for one.
  virtual void learn_background(DepthView, const Frame&) {}
  /// Begins with this one.
  virtual void set_background(DepthView) {}
  /// What was learned; none where there is nothing to learn.
  virtual std::optional<DepthImage> background_m() const { return {}; }

 protected:
  /// For each frame, once it is observed.
  void mark(Exposure& exposure) {
    own_ = exposure.watch;
    put_watch(exposure);
  }
  /// The same after tell_watch().
  void put_watch(Exposure& exposure) const {
    exposure.watch = found_.value_or(own_);
    if (is_told_ && !found_) exposure.watch.has_moved = exposure.watch.is_implausible = false;
    exposure.watch.is_implausible |= is_distrusted_;
  }
  bool is_told() const { return is_told_; }

 private:
  CameraWatch own_;
  std::optional<CameraWatch> found_;
  bool is_told_ = false;
  bool is_distrusted_ = false;
};

/// Observes on the CPU; asks on `gl` if the scene's method runs there. Cameras whose images have
/// the same size may share a pool: then one frame more than there are cameras is enough.
std::unique_ptr<FramePipeline> make_cpu_pipeline(const OpenScene& scene, const OpenCamera& camera,
                                                 const FramePool& pool, GlBackend* gl);

}  // namespace berth
