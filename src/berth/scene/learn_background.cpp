#include "berth/scene/learn_background.hpp"

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

}  // namespace berth
