#pragma once

#include <cstdint>
#include <vector>

#include "berth/self_filter/grown_robot.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// Where padding of flying_patch_radius_m would reach. Found tile by tile, when it is asked for:
/// few tiles have obstacles that hang on the robot.
class Neighbourhood {
 public:
  /// As GrownRobot::begin, which says what the discs are.
  void begin(const Camera& camera, const RobotImage& robot, const SelfFilterSettings& settings,
             const Outline& outline);

  /// Whether this obstacle lies in it. From begin() on, the obstacles of a tile stay the same until
  /// one of them is asked for.
  bool holds(Pixel p, DepthView sensor_depth_m, const Image<PixelFate>& fate);

 private:
  void make_discs();

  GrownRobot grown_;
  const Outline* outline_ = nullptr;
  TileGrid grid_;
  bool has_discs_ = false;
  /// Of each tile, whether it was found, and which of its obstacles lie in it.
  std::vector<std::uint8_t> is_found_;
  std::vector<TileBits> near_;
};

struct FlyingPatchWorkspace {
  Neighbourhood neighbourhood;
  /// What the robot's own readings lead to: where a piece begins that hangs on it.
  std::vector<Pixel> seam;
  /// The state of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// The obstacles of which something is known, piece by piece.
  std::vector<Pixel> walked;
  /// Those of the piece that is being walked whose neighbours nobody has looked at.
  std::vector<Pixel> open;
  /// The free rim of the piece that is being judged.
  std::vector<Pixel> rim;
};

/// Judges pieces of obstacles that may be drawn by the camera: joined by depth (8 neighbours,
/// joined.hpp), wholly in the neighbourhood, and hanging on the robot's own readings (append_seam).
/// A camera that smooths draws such flying pixels out from the arm, without a step, and so does a
/// thing that touches the arm's outline at its depth. Their rims differ: flying pixels end in a
/// wide hole, a thing ends in a step to what stands behind it. A piece is
///  - a **thing**, kept, if a quarter of its free rim and at least 10 pixels of it are sharp: the
///    nearest reading that is not the piece's lies more than 3 cm max(1, z^2) deeper, across a hole
///    of at most 1.5 pixels or 4 mm. The free rim is all its neighbours (8) that show neither the
///    robot nor its padding;
///  - else **undecided**: `flying_patch`. It gives no surface, and is unknown from its readings on.
/// A smaller one is a crumb: `speckle`. A piece that leaves the neighbourhood anywhere, as an arm
/// that reaches in does, is kept, and so is one that is joined to one of the `things`, obstacles
/// that are known to be real.
///
/// Only what hangs is walked, and only until it leaves.
void judge_flying_patches(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                          const Tolerance& tolerance, const std::vector<Pixel>& things,
                          FlyingPatchWorkspace& workspace, ObstacleImage& out);

/// Appends the pixels within `pixels` that have a neighbour (8) of fate `robot`, and the fate
/// `obstacle` or `padding`. Some may come twice.
void append_beside_robot(const Image<PixelFate>& fate, const PixelRect& pixels,
                         std::vector<Pixel>& found);

}  // namespace berth
