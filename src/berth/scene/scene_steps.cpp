#include "berth/scene/scene_steps.hpp"

#include <algorithm>

namespace berth {

std::vector<ImageStep> scene_steps(const OpenScene& scene) {
  std::vector<ImageStep> steps;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
      steps.push_back({c, k, camera.at_exposure[k].stamp_s, 0, true, 0});
    }
  }
  std::ranges::stable_sort(steps, {}, &ImageStep::stamp_s);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i].begins_result = i == 0 || steps[i - 1].stamp_s != steps[i].stamp_s;
    steps[i].result = i == 0 ? 0 : steps[i - 1].result + (steps[i].begins_result ? 1 : 0);
  }
  for (std::size_t i = steps.size(); i-- > 0;) {
    const bool is_last = i + 1 == steps.size() || steps[i + 1].begins_result;
    steps[i].known = is_last ? i + 1 : steps[i + 1].known;
  }
  return steps;
}

}  // namespace berth
