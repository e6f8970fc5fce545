// Inside scene/ only: what many images of a camera show of the place.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

/// Images of a camera that follow each other.
struct ImageRun {
  std::size_t first;
  std::size_t count;
};

/// What a run of a scene learns a background from: no more images than this, or than eight times
/// background_frames where that is more.
inline constexpr std::size_t kMostToLearnFrom = 256;

/// All images of the camera, or of a long recording runs of them that lie evenly over it.
std::vector<ImageRun> images_to_learn_from(const OpenCamera& camera);

/// Calls learn(depth_m, frame) for each of these images, with what an Observer makes of it;
/// `before_image` is called before each.
void learn_background(const OpenCamera& camera, const std::vector<ImageRun>& runs,
                      const std::function<void()>& before_image,
                      const std::function<void(DepthView, const Frame&)>& learn);

}  // namespace berth
