#pragma once

#include <cstddef>
#include <vector>

#include "berth/scene/open_scene.hpp"

namespace berth {

/// One image of a scene, in the order of its results.
struct ImageStep {
  std::size_t camera;
  /// Its number among the images of its camera.
  std::size_t frame;
  double stamp_s;
  /// The number of its result: where cameras are joined among all, else among those of its camera.
  std::size_t result;
};

/// All of them: with method `mesh` in the order of their stamps, else camera by camera.
std::vector<ImageStep> scene_steps(const OpenScene& scene);

/// With method `mesh`, the number of steps up to the last one with the stamp of steps[step], all of
/// which its answer knows; with the others step + 1.
std::size_t steps_known_at(const OpenScene& scene, const std::vector<ImageStep>& steps,
                           std::size_t step);

}  // namespace berth
