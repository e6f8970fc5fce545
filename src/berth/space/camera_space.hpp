#pragma once

#include <cstdint>

#include "berth/space/closed_free_depth.hpp"
#include "berth/space/depth_cells.hpp"
#include "berth/space/depth_windows.hpp"
#include "berth/space/free_depth.hpp"
#include "berth/space/hidden_depth.hpp"
#include "berth/space/robot_holes.hpp"
#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

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
  /// this; 0 where the pixel frees nothing (whole-robot definition 2).
  DepthWindows free_depth;
  /// H: a point that projects into this pixel and lies farther away than this is hidden by it
  /// (definition 5); endless where the pixel hides nothing.
  DepthWindows hidden_depth;
  /// Up to where it is: what lies behind environment's front was hidden by no pixel if it saw
  /// environment, and is not by what stands before it. Not built where there is no environment.
  bool has_environment = false;
  DepthCeiling environment_front;

  /// S, rounded down, and what each pixel by itself frees (definition 1): what E is made of once
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
