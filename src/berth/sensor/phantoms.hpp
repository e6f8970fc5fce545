#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

/// The memory of drop_phantoms().
struct PhantomWorkspace {
  std::vector<Pixel> lonely;
};

/// How many readings a thing of the size d shows at least at this depth, with itself: a quarter of
/// the pixels that a ball of this diameter covers, at most kMostSupport. One is nothing to ask for.
int support_of_phantom_rule(const Camera& camera, double phantom_radius_m, float depth_m);
inline constexpr int kMostSupport = 5;
/// Nobody looks farther than this for them.
inline constexpr int kMostSupportReach_px = 8;
/// Over the depth squared, how far in depth two readings of one surface may be apart: a camera that
/// measures by triangulation has steps and noise of about as much. From 2.7 m on more than 3 cm.
inline constexpr double kDepthStep_per_m = 0.004;

/// Drops as `speckle` the readings that are alone in space: in the square of pixels that are at
/// most f d / z, and kMostSupportReach_px, to the side of it, fewer than support_of_phantom_rule()
/// pixels are within d of it in depth, and kDepthStep_per_m z^2, itself among them: kept ones, and
/// readings that were dropped but do not show robot or environment. So what padding took of a thing
/// beside the arm still stands by what is left of it. A camera makes such readings up between near
/// and far, and in the air; of a thing of the size d, a rod or a cable it gives more. Counts are of
/// the image as it came: it does not matter who is dropped first. 0 turns the rule off.
void drop_phantoms(const Camera& camera, DepthView sensor_depth_m, double phantom_radius_m,
                   PhantomWorkspace& workspace, ObstacleImage& out);

}  // namespace berth
