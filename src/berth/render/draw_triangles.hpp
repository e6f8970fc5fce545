// Inside render/ only: the rasteriser. Every instruction set computes the same bits.
#pragma once

#include <span>

#include "berth/render/key_image.hpp"
#include "berth/render/link_in_image.hpp"
#include "berth/render/triangle_block.hpp"
#include "berth/render/triangle_planes.hpp"

namespace berth {

/// Triangles in the image that may cover a pixel's centre, gathered so that vectors are full.
struct ImageTriangles {
  static constexpr int kFull = 256;
  static constexpr int kCapacity = kFull + TriangleBlock::kTriangles;
  int count = 0;
  /// By corner.
  alignas(64) float u[3][kCapacity];
  alignas(64) float v[3][kCapacity];
  alignas(64) float inverse_depth[3][kCapacity];
  /// Their pixels, as in TrianglePlanes.
  alignas(64) float first_u[kCapacity];
  alignas(64) float first_v[kCapacity];
  alignas(64) float last_du[kCapacity];
  alignas(64) float last_dv[kCapacity];
};

/// What one thread draws on.
struct Canvas {
  KeyImage keys;
  /// False while all keys are 0.
  bool used = false;
  ImageTriangles waiting;
  TrianglePlanes planes;
};

/// Raises the keys of the pixels whose centres lie in the triangles, whatever their winding; where
/// the keys have ceilings, by what lies behind them.
void draw_triangles(std::span<const TriangleBlock> blocks, const LinkInImage& view, Canvas& canvas);

}  // namespace berth
