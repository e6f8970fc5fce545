#pragma once

#include <cstdint>

#include "berth/space/closed_free_depth.hpp"
#include "berth/space/depth_cells.hpp"
#include "berth/space/depth_windows.hpp"
#include "berth/space/free_depth.hpp"
#include "berth/space/robot_holes.hpp"
#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
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

/// The environment of the URDF along a camera's rays, if there were no robot; images of no size
/// where there is none.
struct EnvironmentSurfaces {
  /// The depth of the surface that the camera sees, and of the one where its solid ends; NaN where
  /// the ray meets none.
  DepthView front_m = {};
  DepthView back_m = {};
  /// Surfaces with the same number are the same (next_serial_number()); 0: nobody knows.
  std::uint64_t serial_number = 0;
};

/// What one depth image says of the space before its camera: surfaces, what they hide, and what is
/// free. Made once a frame, at the camera's clock; then constant.
struct CameraSpace {
  Camera camera;
  SpaceSettings settings;
  /// F: the depth of what may be an obstacle; NaN elsewhere. The pixels are those of the image that
  /// this was made of, which have to stay where they are and as they are.
  DepthView obstacle_depth_m;
  /// The depth ranges of F.
  DepthCells cells;

  /// Whether what follows is there: without it only readings can be asked for.
  bool has_free_depth = false;
  /// E: a point that projects into this pixel is seen free while it is nearer to the camera than
  /// this; 0 where the pixel frees nothing (D2).
  DepthWindows free_depth;
  /// H: a point that projects into this pixel and lies farther away than this is hidden by it
  /// (D5); endless where the pixel hides nothing.
  DepthWindows hidden_depth;
  /// Up to where it is: what lies behind environment's front was hidden by no pixel if it saw
  /// environment, and is not by what stands before it. Not built where there is no environment.
  bool has_environment = false;
  DepthCeiling environment_front;

  /// S, rounded down, and what each pixel by itself frees (D1): what E is made of once
  /// more, when newer frames have made this one old.
  UnitImage sensor_depth;
  UnitImage own_free_depth;
  /// Of the surfaces that environment_front was made of.
  std::uint64_t environment_number = 0;
  /// Scratch.
  UnitImage front_to_end;
  RobotHolesWorkspace robot_holes;
  ClosingWorkspace closing;

  /// Whether pixels hide that F has no depth at.
  bool hides_without_reading = false;

  bool is_empty() const { return obstacle_depth_m.width == 0 || obstacle_depth_m.height == 0; }
};

/// Writes `out`, whose memory it reuses. `sensor_depth_m` is the raw image S, `obstacles` what the
/// self filter made of it, which `out` goes on to refer to; both have the camera's size. Throws
/// std::invalid_argument for bad settings.
void build_camera_space(const Camera& camera, DepthView sensor_depth_m,
                        const ObstacleImage& obstacles, const EnvironmentSurfaces& environment,
                        const SpaceSettings& settings, CameraSpace& out);

/// The same for requests about readings alone (MeshRequest::hidden is false): such a view frees
/// nothing.
void build_reading_space(const Camera& camera, DepthView obstacle_depth_m,
                         const SpaceSettings& settings, CameraSpace& out);

}  // namespace berth
