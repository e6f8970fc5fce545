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
  /// The number of its result, that of its stamp.
  std::size_t result;
  /// Whether it is the first image of that result.
  bool begins_result;
  /// How many steps its result knows: all up to the last one of its stamp.
  std::size_t known;
};

/// All of them in the order of their stamps.
std::vector<ImageStep> scene_steps(const OpenScene& scene);

}  // namespace berth
