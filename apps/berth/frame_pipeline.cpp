#include "apps/berth/frame_pipeline.hpp"

#include <optional>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/gl_asker.hpp"
#include "berth/pipeline/gl_observer.hpp"

namespace berth {
namespace {

/// Asks on the backend that the method runs on; made at the first question.
class AnyAsker {
 public:
  explicit AnyAsker(const Rig& rig) : rig_(rig) {}

  const Answer& ask(const Frame& frame) {
    if (runs_on_opengl()) return made_gl().ask(frame);
    if (!cpu_) cpu_.emplace(rig_);
    return cpu_->ask(frame);
  }
  const Answer& ask(const GlFrame& frame) { return made_gl().ask(frame); }
  bool runs_on_opengl() const { return berth::runs_on_opengl(rig_.settings().method); }

 private:
  GlAsker& made_gl() { return gl_ ? *gl_ : gl_.emplace(rig_); }

  const Rig& rig_;
  std::optional<Asker> cpu_;
  std::optional<GlAsker> gl_;
};

class CpuPipeline : public FramePipeline {
 public:
  explicit CpuPipeline(const Rig& rig) : observer_(rig), asker_(rig) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    observer_.observe(depth_m, at_exposure, frame_, time);
  }
  const Answer& ask() override { return asker_.ask(frame_); }
  const Exposure& exposure() const override { return frame_; }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return frame_.obstacles.count;
  }
  const Frame& frame() override { return frame_; }
  Observer* cpu_observer() override { return &observer_; }

 private:
  Observer observer_;
  AnyAsker asker_;
  Frame frame_;
};

class GlPipeline : public FramePipeline {
 public:
  explicit GlPipeline(const Rig& rig)
      : rig_(rig), observer_(rig), asker_(rig), gl_frame_(rig.camera()) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    observer_.observe(depth_m, at_exposure, gl_frame_, time);
  }
  const Answer& ask() override {
    return asker_.runs_on_opengl() ? asker_.ask(gl_frame_) : asker_.ask(frame());
  }
  const Exposure& exposure() const override { return gl_frame_; }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return observer_.fate_counts();
  }
  const Frame& frame() override {
    read_back(rig_.camera(), gl_frame_, frame_);
    return frame_;
  }
  Observer* cpu_observer() override { return nullptr; }

 private:
  const Rig& rig_;
  GlObserver observer_;
  AnyAsker asker_;
  GlFrame gl_frame_;
  Frame frame_;
};

}  // namespace

std::unique_ptr<GlContext> open_context(const app::BackendArguments& where, Method method) {
  if (where.backend == app::Backend::cpu && !runs_on_opengl(method)) return nullptr;
  return std::make_unique<GlContext>(where.gl_device);
}

std::unique_ptr<FramePipeline> make_frame_pipeline(const Rig& rig, app::Backend backend) {
  if (backend == app::Backend::opengl) return std::make_unique<GlPipeline>(rig);
  return std::make_unique<CpuPipeline>(rig);
}

}  // namespace berth
