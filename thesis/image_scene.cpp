#include "thesis/image_scene.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "berth/scene/camera_frames.hpp"
#include "berth/scene/repeated_request.hpp"
#include "thesis/image_query.hpp"

namespace berth {
namespace {

class CameraOnCpu : public ImageCamera {
 public:
  CameraOnCpu(const OpenCamera& camera, ImageQuery query)
      : frames_(camera, FramePool()), query_(std::move(query)) {}

  void begin(const std::function<void()>& before_image) override {
    frames_.begin_background(before_image);
  }
  void observe(std::size_t image) override {
    frames_.observe(image);
    query_.prepare(*frames_.frame());
  }
  const ImageResult& ask() override { return query_.ask(*frames_.frame()); }
  std::array<std::int64_t, kPixelFateCount> fate_counts() override {
    return frames_.frame()->obstacles.count;
  }
  void distrust() override { frames_.distrust(); }

 private:
  CameraFrames frames_;
  ImageQuery query_;
};

}  // namespace

ImageScene::ImageScene(const OpenScene& scene, Method method, const ImageSettings& settings,
                       const BackendChoice& where, const std::function<void()>& before_image)
    : scene_(scene),
      plausibility_(require_plausible(scene)),
      gl_(needed_gl_backend(method, where)) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    cameras_.push_back(make_camera(scene.cameras[i], method, settings, where.backend));
    if (plausibility_[i].is_implausible) {
      cameras_[i]->distrust();
    } else {
      cameras_[i]->begin(before_image);
    }
  }
}

std::unique_ptr<ImageCamera> ImageScene::make_camera(const OpenCamera& camera, Method method,
                                                     const ImageSettings& settings,
                                                     Backend backend) {
  try {
    if (backend == Backend::opengl) return gl_->make_camera(scene_, camera, method, settings);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene_.file.string(), error.what()));
  }
  return std::make_unique<CameraOnCpu>(
      camera, ImageQuery(scene_.robot, method, settings,
                         gl_ ? gl_->make_method(method) : make_image_method(method)));
}

bool ImageScene::next() {
  if (gl_ && taken_ > 0) gl_->check(scene_.cameras[camera_].source.name);
  while (camera_ < cameras_.size() && taken_ == scene_.cameras[camera_].source.depth.size()) {
    ++camera_;
    taken_ = 0;
  }
  if (camera_ == cameras_.size()) return false;
  cameras_[camera_]->observe(taken_++);
  return true;
}

ImageResult ImageScene::ask(int repeat) {
  const auto ask = [this](int) -> const ImageResult& { return cameras_[camera_]->ask(); };
  std::optional<RequestTiming> timing;
  ImageResult told = ask_repeatedly(repeat, ask, timing);
  told.timing_name = "evaluate_us";
  told.timing = timing;
  told.frame = told.cameras.front().frame = static_cast<int>(taken_ - 1);
  told.stamp_s = scene_.cameras[camera_].at_exposure[taken_ - 1].stamp_s;
  told.cameras.front().self_filter = cameras_[camera_]->fate_counts();
  if (gl_) told.gl_renderer = gl_->renderer();
  return told;
}

}  // namespace berth
