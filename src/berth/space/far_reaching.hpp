// Inside space/ only: those pixels whose age reaches far beside them.
#pragma once

#include <array>

#include "berth/space/aged_depth.hpp"

namespace berth {

/// Pixels with a greater reach are spread by squares, the others by rings.
inline constexpr int kMostRing = 24;

/// How many pixels beside it a pixel with a reading holds.
class Reach {
 public:
  Reach(const Camera& camera, double moved_m);

  /// At most `most`.
  int of(float sensed_m, int most) const;
  /// A reading below the first r of these numbers has the reach r, up to kMostRing + 1, which
  /// stands for all beyond.
  const float* borders_m() const { return borders_m_.data(); }

 private:
  double spread_;
  std::array<float, kMostRing + 1> borders_m_;
};

/// What the pixels whose workspace.reach is above kMostRing leave, taken into `out`.
void hold_far_reaching(const Reach& reach, const DepthImage& sensor_depth_m,
                       const DepthImage& own_m, float moved_m, AgingWorkspace& workspace,
                       DepthImage& out);

}  // namespace berth
