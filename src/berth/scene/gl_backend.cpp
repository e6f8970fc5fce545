#include "berth/scene/gl_backend.hpp"

#include "berth/image_distance/image_query.hpp"
#include "berth/image_distance/opengl/gl_context.hpp"
#include "berth/image_distance/opengl/gl_image_query.hpp"
#include "berth/image_distance/opengl/gl_observer.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/scene/frame_pipeline.hpp"

namespace berth {
namespace {

class GlPipeline : public FramePipeline {
 public:
  explicit GlPipeline(const OpenCamera& camera)
      : observer_(camera.view), gl_frame_(camera.view->camera()) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    observer_.observe(depth_m, at_exposure, gl_frame_, time);
    mark(gl_frame_);
  }
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
  FramePool pool_;

 protected:
  GlFrame gl_frame_;
  std::shared_ptr<Frame> frame_;
};

/// The same for a method that compares images on the processor.
class ReadBackPipeline : public GlPipeline {
 public:
  ReadBackPipeline(const OpenScene& scene, const OpenCamera& camera)
      : GlPipeline(camera), query_(scene.robot, scene.method, scene.image_settings) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    GlPipeline::observe(depth_m, at_exposure, time);
    query_.prepare(*frame());
  }
  const Result& ask() override { return query_.ask(*frame_); }
  std::shared_ptr<const Frame> kept() override { return nullptr; }

 private:
  ImageQuery query_;
};

/// The same for one that compares them on OpenGL.
class GlImagePipeline : public GlPipeline {
 public:
  GlImagePipeline(const OpenScene& scene, const OpenCamera& camera)
      : GlPipeline(camera), query_(scene.robot, scene.method, scene.image_settings) {}

  const Result& ask() override { return query_.ask(gl_frame_); }
  std::shared_ptr<const Frame> kept() override { return nullptr; }

 private:
  GlImageQuery query_;
};

class OpenGl : public GlBackend {
 public:
  explicit OpenGl(const std::string& device) : context_(device) {}

  std::string renderer() const override { return context_.renderer(); }
  void check(const std::string& what) override { context_.check(what); }
  std::unique_ptr<FramePipeline> make_pipeline(const OpenScene& scene,
                                               const OpenCamera& camera) override {
    if (scene.joins_cameras()) return std::make_unique<GlPipeline>(camera);
    if (runs_on_opengl(scene.method)) return std::make_unique<GlImagePipeline>(scene, camera);
    return std::make_unique<ReadBackPipeline>(scene, camera);
  }
  std::unique_ptr<ImageMethod> make_method(Method method) override {
    return make_gl_method(method);
  }

 private:
  GlContext context_;
};

}  // namespace

std::unique_ptr<GlBackend> open_gl_backend(const std::string& device) {
  return std::make_unique<OpenGl>(device);
}

}  // namespace berth
