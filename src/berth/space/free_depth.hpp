// How far each pixel of a camera sees free space.
#pragma once

#include <vector>

#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// What each pixel frees by itself (whole-robot definition 1); 0 where that is nothing, and the
/// greatest float where nothing ends it. With a reading in F it is F - m, where F is a learned
/// background the lesser of that and S + rho; with a reading of the robot or environment, beside it
/// included, S + rho; with another one that was dropped, S - m. A pixel without a reading takes the
/// least of its neighbours with readings if they are at least five of eight, unless
/// SpaceSettings::no_reading says that it is free. All sizes are equal; reuses out's memory.
void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         const SpaceSettings& settings, DepthImage& out);

/// Free depth E (definition 2): the least of 3 x 3 pixels; 0 in the outermost ring.
void find_free_depth(const DepthImage& own_m, DepthImage& out);

/// What a row's pixels have left, and how many pixels beside them it holds.
struct AgedRow {
  std::vector<float> left_m;
  std::vector<int> reach;
};

/// The memory of age_own_free_depth().
struct AgingWorkspace {
  /// levels[k]: values that hold in squares of 2^k x 2^k pixels, by their first pixel.
  std::vector<DepthImage> levels;
  AgedRow row;
};

/// What each pixel still frees after something may have moved by `moved_m`: that much less, and
/// what a pixel with a reading S has left holds for all that are no more than
/// ceil(f moved_m / S) pixels from it sideways, f the greater of both focal lengths.
void age_own_free_depth(const Camera& camera, const DepthImage& sensor_depth_m,
                        const DepthImage& own_m, double moved_m, AgingWorkspace& workspace,
                        DepthImage& out);

}  // namespace berth
