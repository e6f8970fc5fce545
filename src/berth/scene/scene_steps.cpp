#include "berth/scene/scene_steps.hpp"

#include <algorithm>

namespace berth {

std::vector<ImageStep> scene_steps(const OpenScene& scene) {
  std::vector<ImageStep> steps;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
      steps.push_back({c, k, camera.at_exposure[k].stamp_s, k});
    }
  }
  if (!scene.joins_cameras()) return steps;
  std::stable_sort(steps.begin(), steps.end(),
                   [](const ImageStep& a, const ImageStep& b) { return a.stamp_s < b.stamp_s; });
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i].result = i;
  return steps;
}

std::size_t steps_known_at(const OpenScene& scene, const std::vector<ImageStep>& steps,
                           std::size_t step) {
  std::size_t known = step + 1;
  while (scene.joins_cameras() && known < steps.size() &&
         steps[known].stamp_s == steps[step].stamp_s) {
    ++known;
  }
  return known;
}

}  // namespace berth
