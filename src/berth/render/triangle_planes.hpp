// Inside render/ only.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "berth/types/image.hpp"

namespace berth {

/// As many triangles as the widest vector has lanes, so that their corners load without gathers.
struct TriangleBlock {
  static constexpr int kTriangles = 16;
  /// By corner, axis and triangle; m, in the link's frame L.
  alignas(64) float corner_L_m[3][3][kTriangles];
};

/// How far outside of a triangle a pixel centre still belongs to it. The corners are rounded by up
/// to 1e-3 px, once here and once there where neighbours go different ways: without tolerance, a
/// centre on their common edge could fall between them.
inline constexpr float kEdgeTolerance_px = 1.0F / 512;

/// Projected triangles as functions over the image. Each is linear in the pixel's offset from the
/// triangle's first pixel: f = f[0] + f[1] du + f[2] dv.
struct TrianglePlanes {
  static constexpr int kTriangles = TriangleBlock::kTriangles;
  /// The triangle is where all three are at least 0, tolerance included.
  alignas(64) float edge[3][3][kTriangles];
  alignas(64) float inverse_depth[3][kTriangles];
  /// Its range over the triangle: beyond its edge, however little, a sliver's plane means nothing.
  alignas(64) float inverse_depth_lo[kTriangles];
  alignas(64) float inverse_depth_hi[kTriangles];
  /// The rectangle of pixel centres that it may cover: whole numbers, the last pixel included.
  alignas(64) float u[kTriangles];
  alignas(64) float v[kTriangles];
  alignas(64) float last_du[kTriangles];
  alignas(64) float last_dv[kTriangles];
};

/// In doubles, for triangles of any size that may reach behind the camera. A corner is (u z, v z,
/// z). Writes to the place `lane`; false where no pixel of `rect` can show the triangle.
bool plan_exactly(const std::array<Eigen::Vector3d, 3>& corners, const PixelRect& rect, int lane,
                  TrianglePlanes& out);

}  // namespace berth
