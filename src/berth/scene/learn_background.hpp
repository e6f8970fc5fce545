// Inside scene/ only: what all images of a camera show of the place.
#pragma once

#include <functional>

#include "berth/pipeline/frame.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

/// Calls learn(depth_m, frame) for each of the camera's images, with what an Observer makes of it;
/// `before_image` is called before each.
void learn_background(const OpenCamera& camera, const std::function<void()>& before_image,
                      const std::function<void(DepthView, const Frame&)>& learn);

}  // namespace berth
