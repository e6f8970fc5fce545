#pragma once

#include <vector>

#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct SurfaceThingsWorkspace {
  /// The state of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// Readings that stand off the model, then those of them that make a patch.
  std::vector<Pixel> candidates;
  std::vector<Pixel> patch;
  /// The pixels that were found; until the next image.
  std::vector<Pixel> things;
};

/// How much a tolerance in space grows with the depth: a sensor's noise does, with z^2.
inline constexpr double kLeastSurfaceGrowth = 0.8;
inline double surface_growth(double z_m) {
  return std::max(kLeastSurfaceGrowth, 0.65 + 0.35 * z_m * z_m);
}

/// t, in metres at 1 m, between kLeastSurfaceTolerance_m and kMostSurfaceTolerance_m: how far
/// readings of a surface may stand off its model. What lies deeper than the model is never a thing
/// that lies on it, so that t is what 98 % of the readings stay below: (reading - model) / growth,
/// at pixels more than 1.5 cm beside the model's edges. Where the median is less than 0, the camera
/// reads everything too near, and t is what 98 % stay below on the other side of it.
/// kMostSurfaceTolerance_m where fewer than 100 such pixels are looked at, of each third one.
SurfaceTolerance measured_surface_tolerance(const Camera& camera, DepthView sensor_depth_m,
                                            const RobotImage& robot);
inline constexpr double kLeastSurfaceTolerance_m = 0.010;
inline constexpr double kMostSurfaceTolerance_m = 0.025;

/// Gives the fate `obstacle`, and their depths, to readings on the robot and on environment that
/// stand off the model in space: a hand on the arm, or on the table. Of a reading (the median of
/// 3 x 3; it stands off along its ray by 0.8 of that itself) of the fate `robot` or `environment`,
/// s is its distance to all of the model that the camera would see. It stands off where s is more
/// than t growth(z); 3 cm^2 of them side by side (8 neighbours) are a thing.
/// Readings within 2 cm (5 mm where t is 15 mm or less) beside a part of the model that is nearer by
/// more than 3 cm, and not in front of that part, are passed over: depth edges between links give
/// such patches. Adds obstacles, takes none. t is SelfFilterSettings::surface_tolerance_m; where that is not given, it
/// is measured, for links and for environment, and written to out.surface_tolerance_m.
void find_surface_things(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                         const SelfFilterSettings& settings, SurfaceThingsWorkspace& workspace,
                         ObstacleImage& out);

}  // namespace berth
