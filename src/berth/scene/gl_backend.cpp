#include "berth/scene/gl_backend.hpp"

#include <optional>

#include "berth/opengl/gl_asker.hpp"
#include "berth/opengl/gl_context.hpp"
#include "berth/opengl/gl_evaluate.hpp"
#include "berth/opengl/gl_observer.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/scene/frame_pipeline.hpp"

namespace berth {
namespace {

class GlPipeline : public FramePipeline {
 public:
  explicit GlPipeline(const std::shared_ptr<const View>& view)
      : observer_(view), gl_frame_(view->camera()) {
    if (runs_on_opengl(view->robot()->settings().method)) {
      gl_asker_.emplace(view->robot());
    } else {
      asker_.emplace(view->robot());
    }
  }

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    observer_.observe(depth_m, at_exposure, gl_frame_, time);
    mark(gl_frame_);
  }
  const Answer& ask() override {
    return gl_asker_ ? gl_asker_->ask(gl_frame_) : asker_->ask(*frame());
  }
  const Exposure& exposure() const override { return gl_frame_; }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return observer_.fate_counts();
  }
  std::shared_ptr<const Frame> frame() override {
    frame_.reset();
    frame_ = pool_.take();
    read_back(gl_frame_, *frame_);
    return frame_;
  }

 private:
  GlObserver observer_;
  std::optional<Asker> asker_;
  std::optional<GlAsker> gl_asker_;
  GlFrame gl_frame_;
  FramePool pool_;
  std::shared_ptr<Frame> frame_;
};

class FrameAskerOnGl : public FrameAsker {
 public:
  explicit FrameAskerOnGl(const std::shared_ptr<const Robot>& robot) : asker_(robot) {}
  const Answer& ask(const Frame& frame) override { return asker_.ask(frame); }

 private:
  GlAsker asker_;
};

class OpenGl : public GlBackend {
 public:
  explicit OpenGl(const std::string& device) : context_(device) {}

  std::string renderer() const override { return context_.renderer(); }
  void check(const std::string& what) override { context_.check(what); }
  std::unique_ptr<FramePipeline> make_pipeline(const std::shared_ptr<const View>& view) override {
    return std::make_unique<GlPipeline>(view);
  }
  std::unique_ptr<FrameAsker> make_asker(const std::shared_ptr<const Robot>& robot) override {
    return std::make_unique<FrameAskerOnGl>(robot);
  }
  void evaluate(Method method, const Question& question, LinkDistances& out) override {
    if (!evaluator_) evaluator_.emplace();
    evaluator_->evaluate(method, question, out);
  }

 private:
  GlContext context_;
  std::optional<GlEvaluator> evaluator_;
};

}  // namespace

std::unique_ptr<GlBackend> open_gl_backend(const std::string& device) {
  return std::make_unique<OpenGl>(device);
}

}  // namespace berth
