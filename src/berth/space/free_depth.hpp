// How far each pixel of a camera sees free space.
#pragma once

#include "berth/space/depth_windows.hpp"
#include "berth/space/settings.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// Writes S in units (depth_units.hpp), into `hidden` from where on each reading hides, and into
/// `own` what each pixel frees by itself (D1), rounded down to them; 0 where
/// that is nothing, and kEndlessUnits where nothing ends it. A kept reading hides from F + t on, a
/// flying patch from S on: it may be a thing or nothing. With a reading in F it is F - m, where F
/// is a learned background the lesser of that and S + rho; with a reading of the robot, or beside
/// robot or environment, S + rho; with one of environment up to its back, but at least S - m and at
/// most S + rho; with another one that was dropped, S - m. A pixel without a reading, or of the
/// fate `hole`, frees nothing, unless SpaceSettings::no_reading says that it is free
/// (close_free_depth() comes after). `environment_back_m` is where the solid of the environment
/// ends along each pixel's ray; NaN where it is not known, and an image of no size where it is
/// nowhere. All other sizes are equal; reuses the memory. `hidden` gets the image alone.
void find_own_free_depth(DepthView sensor_depth_m, const ObstacleImage& obstacles,
                         DepthView environment_back_m, const SpaceSettings& settings,
                         UnitImage& sensor_depth, DepthWindows& hidden, UnitImage& own);

/// Free depth E (D2): the least of 3 x 3 pixels; 0 in the outermost ring. `out` gets the
/// image alone.
void find_free_depth(const UnitImage& own, DepthWindows& out);

}  // namespace berth
