// What a CameraSpace is made of, pixel by pixel as the definitions say: the slow twins.
#pragma once

#include "berth/space/camera_space.hpp"

namespace berth::testing {

void plain_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                          DepthView environment_back_m, const SpaceSettings& settings,
                          DepthImage& out);
void plain_free_depth_of(const DepthImage& own_m, DepthImage& out);
void plain_depth_cells(DepthView depth_m, DepthCells& cells);
void plain_depth_windows(DepthView image, DepthWindows& windows);

}  // namespace berth::testing
