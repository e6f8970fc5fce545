#include "thesis/gl_backend.hpp"

#include "thesis/image_query.hpp"
#include "thesis/opengl/gl_context.hpp"
#include "thesis/opengl/gl_image_query.hpp"
#include "thesis/opengl/gl_observer.hpp"

namespace berth {
namespace {

/// Its method runs on OpenGL, or on what is read back from there.
class CameraOnGl : public ImageCamera {
 public:
  CameraOnGl(const OpenScene& scene, const OpenCamera& camera, Method method,
             const ImageSettings& settings)
      : camera_(camera), observer_(camera.mounted), gl_frame_(camera.mounted->camera()) {
    if (runs_on_opengl(method)) {
      gl_query_ = std::make_unique<GlImageQuery>(scene.robot, method, settings);
    } else {
      query_ = std::make_unique<ImageQuery>(scene.robot, method, settings);
    }
  }

  void begin(const std::function<void()>&) override {}
  void observe(std::size_t image) override {
    observer_.observe(camera_.read_depth(image), camera_.at_exposure[image], gl_frame_,
                      camera_.exposure_time[image]);
    gl_frame_.watch.is_implausible |= is_distrusted_;
    if (!query_) return;
    read_back(gl_frame_, frame_);
    query_->prepare(frame_);
  }
  const ImageResult& ask() override {
    return query_ ? query_->ask(frame_) : gl_query_->ask(gl_frame_);
  }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return observer_.fate_counts();
  }
  void distrust() override { is_distrusted_ = true; }

 private:
  const OpenCamera& camera_;
  GlObserver observer_;
  GlFrame gl_frame_;
  /// Of whichever kind the method is.
  std::unique_ptr<GlImageQuery> gl_query_;
  std::unique_ptr<ImageQuery> query_;
  Frame frame_;
  bool is_distrusted_ = false;
};

class OpenGl : public GlBackend {
 public:
  explicit OpenGl(const std::string& device) : context_(device) {}

  std::string renderer() const override { return context_.renderer(); }
  void check(const std::string& what) override { context_.check(what); }
  std::unique_ptr<ImageCamera> make_camera(const OpenScene& scene, const OpenCamera& camera,
                                           Method method, const ImageSettings& settings) override {
    return std::make_unique<CameraOnGl>(scene, camera, method, settings);
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
