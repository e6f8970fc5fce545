#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// D of one frame: by how much, on the average, points of the robot have to be moved for it to fit
/// the image, in m; none where the frame does not tell. Called on a thread of its own, for one
/// frame at a time; must not throw. X_PC: where the camera stood in its parent link. Should return,
/// whatever it has, soon after `stop` was requested.
using MeasureDisplacement = std::function<std::optional<double>(
    DepthView depth_m, const JointState& at_exposure, const Pose& X_PC, std::stop_token stop)>;

}  // namespace berth
