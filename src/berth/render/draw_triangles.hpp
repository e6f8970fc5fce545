// Inside render/ only: the rasteriser. Every instruction set computes the same bits.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "berth/render/triangle_planes.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// One link as one camera sees it.
struct LinkInImage {
  LinkId id = kNoLink;
  /// Where it may be seen; nothing of it is drawn outside.
  PixelRect rect;
  /// (u z, v z, z) of a point (x, y, z, 1) of the link's frame L.
  Eigen::Matrix<double, 3, 4> to_pixel_L;
  /// From here on single precision projects the link right within 1e-3 px.
  double single_precision_from_m = 0;
};

inline Eigen::Matrix<double, 3, 4> to_pixel(const Camera& camera, const Pose& X_CL) {
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1;
  return intrinsics * X_CL.matrix().topRows<3>();
}

/// A coordinate of the link's frame is off by up to 2^-24 of itself, some times over: divided by
/// the depth and multiplied by the focal length, that is the error in the image.
inline double single_precision_from_m(const Camera& camera, const Eigen::AlignedBox3f& box_L_m) {
  constexpr double kLoss = 5 * 0x1p-24;
  constexpr double kLargestError_px = 1e-3;
  const auto largest_m = box_L_m.min().cwiseAbs().cwiseMax(box_L_m.max().cwiseAbs()).norm();
  return kLoss / kLargestError_px * std::max(camera.fx_px, camera.fy_px) * largest_m;
}

/// What a pixel shows, as one number: the greater key is the nearer surface, and of two at the same
/// depth the smaller id. So the greatest key does not depend on the order of drawing. The upper
/// half is the inverse depth, a positive float, whose bits sort as it does; 0 where nothing is.
using PixelKey = std::int64_t;

/// The lower half of a key.
inline PixelKey id_part(LinkId id) { return static_cast<LinkId>(~id); }
inline PixelKey make_key(float inverse_depth, PixelKey id) {
  return static_cast<PixelKey>(std::bit_cast<std::uint32_t>(inverse_depth)) << 32 | id;
}
inline float inverse_depth_of(PixelKey key) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
}
inline LinkId id_of(PixelKey key) { return static_cast<LinkId>(~key); }

/// Rows of keys without gaps.
class KeyImage {
 public:
  /// Vectors that begin in the image may end beyond it.
  static constexpr int kPadding = 16;

  KeyImage(int width, int height)
      : width_(width), keys_(static_cast<std::size_t>(width) * height + kPadding) {}

  int width() const { return width_; }
  std::ptrdiff_t place(int u, int v) const { return static_cast<std::ptrdiff_t>(v) * width_ + u; }
  PixelKey* data() { return keys_.data(); }
  PixelKey* row(int v) { return keys_.data() + place(0, v); }

  /// The inverse depth from which on each pixel's surfaces do not count, where only those behind
  /// others do. As long as the keys.
  const float* ceilings() const { return ceilings_; }
  void set_ceilings(const float* ceilings) { ceilings_ = ceilings; }

 private:
  int width_;
  const float* ceilings_ = nullptr;
  std::vector<PixelKey> keys_;
};

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

/// Writes row v of the image: within `extent` what the canvases show together, whose keys become 0
/// again, and nothing outside, where only `before` can hold a robot. Both lie in the image.
void show_row(std::span<Canvas> canvases, int v, const PixelRect& extent, const PixelRect& before,
              RobotImage& image);

}  // namespace berth
