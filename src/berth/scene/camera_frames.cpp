#include "berth/scene/camera_frames.hpp"

#include <algorithm>

#include "berth/pipeline/observer.hpp"

namespace berth {
namespace {

constexpr std::size_t kRunsOfImages = 16;
constexpr std::size_t kImagesForEachThatAgrees = 8;

}  // namespace

std::vector<ImageRun> images_to_learn_from(const OpenCamera& camera) {
  const std::size_t count = camera.source.depth.size();
  const auto agreeing =
      static_cast<std::size_t>(camera.mounted->settings().sensor.background_frames);
  const std::size_t most = std::max(kMostToLearnFrom, kImagesForEachThatAgrees * agreeing);
  if (count <= most) return {{0, count}};
  const std::size_t length = most / kRunsOfImages;
  std::vector<ImageRun> runs;
  for (std::size_t i = 0; i < kRunsOfImages; ++i) {
    runs.push_back({i * (count - length) / (kRunsOfImages - 1), length});
  }
  return runs;
}

void learn_background(const OpenCamera& camera, const std::vector<ImageRun>& runs,
                      const std::function<void()>& before_image,
                      const std::function<void(DepthView, const Frame&)>& learn) {
  Frame frame;
  for (const ImageRun& run : runs) {
    // A new one for each: what it knows of the image before would be of another time.
    Observer observer(camera.mounted);
    for (std::size_t k = run.first; k < run.first + run.count; ++k) {
      before_image();
      const DepthImage depth_m = camera.read_depth(k);
      observer.observe(depth_m, camera.at_exposure[k], frame, camera.exposure_time[k]);
      observer.finish_watch(frame);
      learn(depth_m, frame);
    }
  }
}

CameraFrames::CameraFrames(const OpenCamera& camera, const FramePool& pool)
    : camera_(&camera), observer_(camera.mounted), pool_(pool) {}

void CameraFrames::begin_given_background() {
  if (!camera_->mounted->settings().sensor.has_background()) return;
  if (camera_->background_m) observer_.set_background(*camera_->background_m);
}

void CameraFrames::begin_background(const std::function<void()>& before_image) {
  begin_given_background();
  if (camera_->background_m || !camera_->mounted->settings().sensor.has_background()) return;
  learn_background(
      *camera_, images_to_learn_from(*camera_), before_image,
      [&](DepthView depth_m, const Frame& frame) { observer_.learn_background(depth_m, frame); });
}

std::optional<DepthImage> CameraFrames::background_m() const {
  if (!camera_->mounted->settings().sensor.has_background()) return std::nullopt;
  return observer_.background_m();
}

void CameraFrames::observe(std::size_t image) {
  number_ = image;
  depth_m_ = camera_->read_depth(image);
  // Given back first, so that its memory serves again where nobody else holds it.
  frame_.reset();
  frame_ = pool_.take();
  observer_.observe(depth_m_, camera_->at_exposure[image], *frame_, camera_->exposure_time[image]);
  if (!is_told_) observer_.finish_watch(*frame_);
  own_watch_ = frame_->watch;
  put_watch();
}

void CameraFrames::tell_watch(const CameraWatch* found) {
  is_told_ = true;
  found_ = found ? std::optional(*found) : std::nullopt;
  if (frame_) put_watch();
}

void CameraFrames::put_watch() {
  CameraWatch& watch = frame_->watch;
  watch = found_.value_or(own_watch_);
  if (is_told_ && !found_) watch.has_moved = watch.is_implausible = false;
  watch.is_implausible |= is_distrusted_;
}

}  // namespace berth
