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
  /// The number of its result: where cameras are joined that of its stamp, else among those of its
  /// camera.
  std::size_t result;
  /// Whether it is the first image of that result.
  bool begins_result;
  /// How many steps its result knows: where cameras are joined all up to the last one of its stamp.
  std::size_t known;
  /// The cameras of its result: where cameras are joined all, else its own.
  std::size_t first_camera;
  std::size_t camera_count;
};

/// All of them: with method `mesh` in the order of their stamps, else camera by camera.
std::vector<ImageStep> scene_steps(const OpenScene& scene);

}  // namespace berth
