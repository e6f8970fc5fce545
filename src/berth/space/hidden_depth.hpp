// From where on each pixel of a camera hides, and where that ends.
#pragma once

#include "berth/space/depth_windows.hpp"
#include "berth/space/settings.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The greatest depth of rectangles of an image: windows of what is left from each depth to
/// kEndlessUnits.
struct DepthCeiling {
  DepthWindows left;
};

/// The greatest depth of a rectangle in the image, and of little else.
inline float greatest_of_m(const DepthCeiling& ceiling, const PixelRect& rect) {
  return in_metres(static_cast<DepthUnits>(kEndlessUnits - least_of(ceiling.left, rect)));
}

/// Lets each pixel of the fate `hole` hide all that it does not free: from `own` (closed) on, and
/// what is between that and a surface that hides, d / 2 (detection capability), the free-space
/// margin and the surface's thickness. So a small hole hides from where its surroundings do, and
/// one that a ball of d fits into from where such a ball may be. `hidden` holds what the image's
/// readings hide (find_own_free_depth()).
void hide_behind_holes(const ObstacleImage& obstacles, const UnitImage& own, double detected_m,
                       const SpaceSettings& settings, DepthWindows& hidden);

/// Writes the ceiling of `environment_front_m`: of each pixel the greatest of 3 x 3, rounded up;
/// endless where one of them shows no environment and in the outermost ring. `scratch` gets another
/// image of this size.
void build_environment_ceiling(DepthView environment_front_m, UnitImage& scratch,
                               DepthCeiling& out);

}  // namespace berth
