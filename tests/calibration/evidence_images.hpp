// One image of a wall, with a plate before it: what a camera at the base's origin sees along z.
#pragma once

#include "berth/calibration/evidence_view.hpp"

namespace berth {

inline constexpr double kPlate_m = 1.0;
inline constexpr double kWall_m = 2.0;

/// The plate goes 10 cm to each side, moves, and is held by link 0 at the base.
inline EvidenceView plate_view() {
  EvidenceView view;
  view.camera = {160, 120, 200, 200, 79.5, 59.5};
  view.X_BC = view.X_CB = Pose::Identity();
  view.pose.X_BL = {Pose::Identity()};
  view.depth_m.resize(160, 120, static_cast<float>(kWall_m));
  view.kind.resize(160, 120, ReadingKind::fixed);
  view.uncertainty_m = 0.01;
  for (int v = 40; v < 80; ++v) {
    for (int u = 60; u < 100; ++u) {
      view.depth_m(u, v) = static_cast<float>(kPlate_m);
      view.kind(u, v) = ReadingKind::moving;
    }
  }
  return view;
}

}  // namespace berth
