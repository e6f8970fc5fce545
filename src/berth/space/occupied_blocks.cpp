#include "berth/space/blocks.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/occupied_blocks.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/cube_projection-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

constexpr int kMostPixels = 32;

/// The cubes with a pixel whose reading may reach into them.
HWY_INLINE std::uint64_t holds_reading(const CameraSpace& space, const Projection& cubes) {
  if (cubes.span >= kMostPixels) return cubes.meets;
  const IntTag ints;
  const DepthView depth_m = space.obstacle_depth_m;
  const Lanes from =
      Lanes(cubes.za) - Lanes(static_cast<float>(space.settings.surface_thickness_m));
  const Lanes to(cubes.zb);
  LaneMask holds = Lanes(1.0f) < Lanes(0.0f);
  for (int dv = 0; dv <= cubes.span; ++dv) {
    const Ints row = hn::Mul(hn::Min(hn::Add(cubes.v0, hn::Set(ints, dv)), cubes.v1),
                             hn::Set(ints, static_cast<int>(depth_m.stride)));
    for (int du = 0; du <= cubes.span; ++du) {
      const Ints column = hn::Min(hn::Add(cubes.u0, hn::Set(ints, du)), cubes.u1);
      const Lanes reading = hn::GatherIndex(FloatTag(), depth_m.data, hn::Add(row, column));
      holds = hn::Or(holds, both(reading >= from, reading <= to));
    }
  }
  return cubes.meets & bits_of(holds);
}

std::uint64_t find_with_reading(std::span<const FreeingCamera> views, const Cube& cube) {
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  const float reach_m = cube.corner_m().cast<float>().norm() + 4 * edge_m;
  std::uint64_t found = 0;
  for (const FreeingCamera& view : views) {
    if (view.space->is_empty()) continue;
    for (int i = 0; i < 64; i += kLanes) {
      const Projection cubes = project(view, child_centres(cube, i), reach_m, 0.5f * edge_m);
      std::uint64_t of_these = cubes.through;
      if (cubes.meets != 0) of_these |= holds_reading(*view.space, cubes);
      found |= of_these << i;
    }
  }
  return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(find_with_reading);

std::uint64_t find_occupied(std::span<const FreeingCamera> views, const Cube& cube) {
  return HWY_DYNAMIC_DISPATCH(find_with_reading)(views, cube);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
