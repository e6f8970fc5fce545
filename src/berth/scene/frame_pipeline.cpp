#include "berth/scene/frame_pipeline.hpp"

#include <optional>

#include "berth/image_distance/image_method.hpp"
#include "berth/image_distance/image_query.hpp"
#include "berth/pipeline/observer.hpp"

namespace berth {
namespace {

class CpuPipeline : public FramePipeline {
 public:
  CpuPipeline(const OpenCamera& camera, const FramePool& pool)
      : observer_(camera.view),
        has_background_(camera.view->settings().sensor.has_background()),
        pool_(pool) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    // Given back first, so that its memory serves again where nobody else holds it.
    frame_.reset();
    frame_ = pool_.take();
    observer_.observe(depth_m, at_exposure, *frame_, time);
    if (!is_told()) observer_.finish_watch(*frame_);
    mark(*frame_);
  }
  void tell_watch(const CameraWatch* found) override {
    FramePipeline::tell_watch(found);
    if (frame_) put_watch(*frame_);
  }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return frame_->obstacles.count;
  }
  std::shared_ptr<const Frame> frame() override { return frame_; }
  void learn_background(DepthView depth_m, const Frame& frame) override {
    observer_.learn_background(depth_m, frame);
  }
  void set_background(DepthView depth_m) override { observer_.set_background(depth_m); }
  std::optional<DepthImage> background_m() const override {
    return has_background_ ? std::optional(observer_.background_m()) : std::nullopt;
  }

 private:
  Observer observer_;
  bool has_background_;
  FramePool pool_;

 protected:
  std::shared_ptr<Frame> frame_;
};

/// The same for a method that compares images. Its frames serve any query: who runs a scene may ask
/// them what he likes.
class CpuImagePipeline : public CpuPipeline {
 public:
  CpuImagePipeline(const OpenScene& scene, const OpenCamera& camera, const FramePool& pool,
                   std::unique_ptr<ImageMethod> method)
      : CpuPipeline(camera, pool),
        query_(scene.robot, scene.method, scene.image_settings, std::move(method)) {}

  void observe(DepthView depth_m, const JointState& at_exposure, FrameTime time) override {
    CpuPipeline::observe(depth_m, at_exposure, time);
    query_.prepare(*frame_);
  }
  const Result& ask() override { return query_.ask(*frame_); }

 private:
  ImageQuery query_;
};

}  // namespace

std::unique_ptr<FramePipeline> make_cpu_pipeline(const OpenScene& scene, const OpenCamera& camera,
                                                 const FramePool& pool, GlBackend* gl) {
  if (scene.joins_cameras()) return std::make_unique<CpuPipeline>(camera, pool);
  return std::make_unique<CpuImagePipeline>(
      scene, camera, pool, gl ? gl->make_method(scene.method) : make_image_method(scene.method));
}

}  // namespace berth
