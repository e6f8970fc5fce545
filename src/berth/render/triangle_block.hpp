// Inside render/ only.
#pragma once

namespace berth {

/// As many triangles as the widest vector has lanes, so that their corners load without gathers.
struct TriangleBlock {
  static constexpr int kTriangles = 16;
  /// By corner, axis and triangle; m, in the link's frame L.
  alignas(64) float corner_L_m[3][3][kTriangles];
};

}  // namespace berth
