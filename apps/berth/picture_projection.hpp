#pragma once

#include <vector>

#include "apps/berth/picture.hpp"
#include "berth/types/camera.hpp"

namespace berth::app {

/// The pixels of each pair in the image of the camera at X_BC, whichever camera saw the obstacle.
std::vector<PictureLink> projected(const Camera& camera, const Pose& X_BC,
                                   const std::vector<LinkResult>& links);

}  // namespace berth::app
