#include "berth/scene/frame_pipeline.hpp"

#include <optional>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/frame_pool.hpp"

namespace berth {
namespace {

class CpuPipeline : public FramePipeline {
 public:
  CpuPipeline(const std::shared_ptr<const View>& view, GlBackend* gl) : observer_(view) {
    if (runs_on_opengl(view->robot()->settings().method)) {
      gl_asker_ = gl->make_asker(view->robot());
    } else {
      asker_.emplace(view->robot());
    }
  }

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    // Given back first, so that its memory serves again where nobody else holds it.
    frame_.reset();
    frame_ = pool_.take();
    observer_.observe(depth_m, at_exposure, *frame_, time);
    observer_.finish_watch(*frame_);
    mark(*frame_);
  }
  const Answer& ask() override { return asker_ ? asker_->ask(*frame_) : gl_asker_->ask(*frame_); }
  const Exposure& exposure() const override { return *frame_; }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return frame_->obstacles.count;
  }
  std::shared_ptr<const Frame> frame() override { return frame_; }
  void learn_background(DepthView depth_m, const Frame& frame) override {
    observer_.learn_background(depth_m, frame);
  }
  void set_background(DepthView depth_m) override { observer_.set_background(depth_m); }

 private:
  Observer observer_;
  std::optional<Asker> asker_;
  std::unique_ptr<FrameAsker> gl_asker_;
  FramePool pool_;
  std::shared_ptr<Frame> frame_;
};

}  // namespace

std::unique_ptr<FramePipeline> make_cpu_pipeline(const std::shared_ptr<const View>& view,
                                                 GlBackend* gl) {
  return std::make_unique<CpuPipeline>(view, gl);
}

}  // namespace berth
