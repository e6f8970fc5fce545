#pragma once

#include <span>

#include "berth/distance/mesh/view_space.hpp"

namespace berth {

/// A frame's space, and where its camera stood when it was exposed.
struct PosedView {
  const ViewSpace* space = nullptr;
  /// The pose of the optical frame C in the robot's root frame B.
  Pose X_BC = Pose::Identity();
  /// By how much the frame is older than the newest of the set.
  double age_s = 0;
};

/// Everything that the cameras left: all measured surfaces, and every point that one of them hides
/// and no other one sees free. Which parts of space are hidden is found where somebody asks, once,
/// and kept for all later questions, in bounded memory. Any number of threads may ask at a time.
class HiddenSpace {
 public:
  /// Begins anew with these views, which have to outlive it; reuses its memory. Nobody may ask
  /// meanwhile.
  void assign(std::span<const PosedView> views);
};

}  // namespace berth
