// Inside self_filter/ only.
#pragma once

#include <vector>

#include "berth/self_filter/tolerance.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

struct SeamWorkspace {
  /// What is known of each pixel; 0 everywhere between two images.
  Image<std::uint8_t> state;
  /// The pixels of which something is known.
  std::vector<Pixel> known;
};

/// Where the robot's own readings go on into those beside it. Own are the readings on the model's
/// surface: fate `robot`, and not behind it by more than the tolerance. They lead to a pixel beside
/// it by steps to neighbours (8) that are joined (joined.hpp), from pixel to pixel of what was dropped
/// there as `padding` or `dilation`. What stands behind the robot, or before it, is a step away
/// from its readings.
class Seam {
 public:
  /// All but `tolerance` are kept, not copied; `workspace.state` has the image's size.
  Seam(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance, float jump_m,
       const Image<PixelFate>& fate, SeamWorkspace& workspace)
      : depth_m_(sensor_depth_m),
        robot_(robot),
        tolerance_(tolerance),
        jump_m_(jump_m),
        fate_(fate),
        state_(workspace.state),
        known_(workspace.known) {}
  ~Seam();
  Seam(const Seam&) = delete;
  Seam& operator=(const Seam&) = delete;

  /// Whether the robot's own readings lead to this pixel, which has a reading. Over all pixels of
  /// an image the time is linear in their number.
  bool leads_to(Pixel p);

 private:
  bool is_own(int u, int v) const;
  bool walk_from(Pixel start);
  template <class Call>
  bool any_joined(Pixel p, const Call& call) const;

  DepthView depth_m_;
  const RobotImage& robot_;
  Tolerance tolerance_;
  float jump_m_;
  const Image<PixelFate>& fate_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& known_;
};

}  // namespace berth
