#include "berth/render/draw_triangles.hpp"

#include <array>
#include <bit>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/render/draw_triangles.cpp"
#include "hwy/foreach_target.h"

#include "berth/render/fill-inl.hpp"
#include "berth/render/plan-inl.hpp"
#include "berth/render/project-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

/// The most pixels of a rectangle that is filled side by side.
constexpr float kSmall_pixels = 16;

template <Layer layer>
HWY_INLINE void draw_vector(const ImageTriangles& triangles, int first, PixelKey id,
                            Canvas& canvas) {
  const FloatTag d;
  const TrianglePlanes& planes = canvas.planes;
  const auto in_use = hn::FirstN(d, static_cast<std::size_t>(triangles.count - first));
  const auto sound = hn::And(in_use, plan(triangles, first, canvas.planes));
  const auto one = hn::Set(d, 1.0F);
  const auto pixels =
      hn::Mul(hn::Add(hn::Load(d, planes.last_du), one), hn::Add(hn::Load(d, planes.last_dv), one));
  const auto small = hn::Le(pixels, hn::Set(d, kSmall_pixels));
  fill_small<layer>(planes, hn::And(sound, small), id, canvas.keys);
  std::uint32_t others = bits_of(hn::AndNot(small, sound));
  for (; others != 0; others &= others - 1) {
    RowFiller<layer>(planes, std::countr_zero(others), id).fill(canvas.keys);
  }
}

template <Layer layer>
HWY_INLINE void draw_waiting(PixelKey id, Canvas& canvas) {
  for (int first = 0; first < canvas.waiting.count; first += kLanes) {
    draw_vector<layer>(canvas.waiting, first, id, canvas);
  }
  canvas.waiting.count = 0;
}

/// Slow and right for every triangle.
template <Layer layer>
void draw_exactly(const TriangleBlock& block, int lane, const LinkInImage& view, Canvas& canvas) {
  std::array<Eigen::Vector3d, 3> corners;
  for (int corner = 0; corner < 3; ++corner) {
    const Eigen::Vector4d p_L(block.corner_L_m[corner][0][lane], block.corner_L_m[corner][1][lane],
                              block.corner_L_m[corner][2][lane], 1);
    corners[corner] = view.to_pixel_L * p_L;
  }
  if (!plan_exactly(corners, view.rect, 0, canvas.planes)) return;
  RowFiller<layer>(canvas.planes, 0, id_part(view.id)).fill(canvas.keys);
}

template <Layer layer>
HWY_INLINE void draw_all(std::span<const TriangleBlock> blocks, const LinkInImage& view,
                         Canvas& canvas) {
  const Projection projection(view);
  const PixelKey id = id_part(view.id);
  canvas.used = true;
  for (const TriangleBlock& block : blocks) {
    for (int lane = 0; lane < TriangleBlock::kTriangles; lane += kLanes) {
      std::uint32_t hard = project_block(block, lane, projection, canvas.waiting);
      for (; hard != 0; hard &= hard - 1) {
        draw_exactly<layer>(block, lane + std::countr_zero(hard), view, canvas);
      }
    }
    if (canvas.waiting.count >= ImageTriangles::kFull) draw_waiting<layer>(id, canvas);
  }
  draw_waiting<layer>(id, canvas);
}

void draw(std::span<const TriangleBlock> blocks, const LinkInImage& view, Canvas& canvas) {
  draw_all<Layer::first>(blocks, view, canvas);
}
void draw_behind(std::span<const TriangleBlock> blocks, const LinkInImage& view, Canvas& canvas) {
  draw_all<Layer::behind>(blocks, view, canvas);
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(draw);
HWY_EXPORT(draw_behind);

void draw_triangles(std::span<const TriangleBlock> blocks, const LinkInImage& view,
                    Canvas& canvas) {
  if (canvas.keys.ceilings() == nullptr) {
    HWY_DYNAMIC_DISPATCH(draw)(blocks, view, canvas);
  } else {
    HWY_DYNAMIC_DISPATCH(draw_behind)(blocks, view, canvas);
  }
}

}  // namespace berth
#endif  // HWY_ONCE
