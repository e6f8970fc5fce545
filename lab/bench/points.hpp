// The images as points, for methods that know nothing of pixels.
#pragma once

#include <array>
#include <vector>

#include "lab/bench/bench_scene.hpp"

namespace berth::lab {

/// In the camera's optical frame.
using Point = std::array<float, 3>;

/// The centres of the obstacle pixels, back-projected, as far as they lie in the box around the
/// robot's points enlarged by the range: the others answer nothing, and every tree is the faster
/// without them. Reuses the memory of `points_C_m`.
void collect_obstacle_points(const BenchScene& scene, std::vector<Point>& points_C_m);

/// The same of each link's pixels; [i] belongs to the link with the id i + 1.
void collect_robot_points(const BenchScene& scene, std::vector<std::vector<Point>>& points_C_m);

}  // namespace berth::lab
