#pragma once

#include <memory>

#include "lab/bench/bench_scene.hpp"

namespace berth::lab {

/// The visible surface of each link as a mesh in the camera's optical frame C, for scenes that were
/// drawn without a robot behind them. Joins every second pixel to its neighbours where all belong
/// to the link.
std::shared_ptr<const LinkShapes> visible_shapes_C(const Camera& camera, const RobotImage& robot,
                                                   int link_count);

}  // namespace berth::lab
