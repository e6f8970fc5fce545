#pragma once

#include "berth/pipeline/result.hpp"
#include "berth/types/camera.hpp"

namespace berth::app {

/// The pixels of each pair in the image of the camera at X_BC, whichever camera saw the obstacle:
/// what a picture of method `mesh` draws.
void project_pairs(const Camera& camera, const Pose& X_BC, std::vector<LinkResult>& links);

}  // namespace berth::app
