#include "berth/space/blocks.hpp"

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/unknown_blocks.cpp"
#include "hwy/foreach_target.h"

#include "berth/space/cube_projection-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// Some of the image's, or a level's, numbers: each is the lower half of the 32 bits at its place.
HWY_INLINE Ints gather(const DepthUnits* from, Ints places) {
  const IntTag ints;
  const auto pairs =
      hn::GatherOffset(ints, reinterpret_cast<const std::int32_t*>(from), hn::ShiftLeft<1>(places));
  return hn::And(pairs, hn::Set(ints, 0xFFFF));
}

/// in_metres() of many.
HWY_INLINE Lanes metres_of(Ints units) {
  const LaneMask is_endless =
      hn::RebindMask(FloatTag(), hn::Eq(units, hn::Set(IntTag(), kEndlessUnits)));
  const Lanes depth_m = Lanes(hn::ConvertTo(FloatTag(), units)) * Lanes(1 / kUnitsPerMetre);
  return select(is_endless, Lanes(HUGE_VALF), depth_m);
}

/// Whether all of these cubes' pixels are looked at one by one.
HWY_INLINE bool has_few_pixels(const Projection& cubes) {
  return cubes.span < DepthWindows::kMostPixels;
}

/// Calls visit(places) with the place of a pixel of each cube in an image of so many columns, until
/// each of its pixels had a turn.
template <class Visit>
HWY_INLINE void visit_pixels(const Projection& cubes, int columns, Visit visit) {
  const IntTag ints;
  for (int dv = 0; dv <= cubes.span; ++dv) {
    const Ints row =
        hn::Mul(hn::Min(hn::Add(cubes.v0, hn::Set(ints, dv)), cubes.v1), hn::Set(ints, columns));
    for (int du = 0; du <= cubes.span; ++du) {
      visit(hn::Add(row, hn::Min(hn::Add(cubes.u0, hn::Set(ints, du)), cubes.u1)));
    }
  }
}

/// The least of each cube's pixels.
HWY_INLINE Ints least_of(const DepthWindows& windows, const Projection& cubes) {
  const IntTag ints;
  Ints all = hn::Set(ints, kEndlessUnits);
  if (has_few_pixels(cubes)) {
    const DepthWindows::Level& image = windows.levels[0];
    visit_pixels(cubes, image.columns, [&](Ints places) HWY_ATTR {
      all = hn::Min(all, gather(image.least.data(), places));
    });
    return all;
  }
  const DepthWindows::Level& level = windows.level_for(cubes.span + 1);
  const int shift = __builtin_ctz(static_cast<unsigned>(level.step_px));
  // The first window that ends behind the last pixel, from its last pixel on.
  const Ints to_first = hn::Set(ints, level.step_px - level.side_px);
  const auto place = [&](Ints first, Ints last, Ints out[2]) HWY_ATTR {
    out[0] = hn::ShiftRightSame(first, shift);
    out[1] = hn::Max(out[0], hn::ShiftRightSame(hn::Add(last, to_first), shift));
  };
  Ints columns[2] = {cubes.u0, cubes.u0}, rows[2] = {cubes.v0, cubes.v0};
  place(cubes.u0, cubes.u1, columns);
  place(cubes.v0, cubes.v1, rows);
  for (const Ints row : rows) {
    const Ints begin = hn::Mul(row, hn::Set(ints, level.columns));
    for (const Ints column : columns) {
      all = hn::Min(all, gather(level.least.data(), hn::Add(begin, column)));
    }
  }
  return all;
}

HWY_INLINE Lanes least_of_m(const DepthWindows& windows, const Projection& cubes) {
  return metres_of(least_of(windows, cubes));
}

/// What is left from a depth to kEndlessUnits, as the depth.
HWY_INLINE Lanes ceiling_of_m(Ints left) {
  return metres_of(hn::Sub(hn::Set(IntTag(), kEndlessUnits), left));
}

/// The cubes that lie before the environment, as a whole or in part, where some pixel hides.
HWY_INLINE std::uint64_t reach_before_environment(const CameraSpace& space,
                                                  const Projection& cubes) {
  const DepthWindows& left = space.environment_front.left;
  if (!has_few_pixels(cubes)) {
    return bits_of(Lanes(cubes.za) < ceiling_of_m(least_of(left, cubes)));
  }
  // Depth and front of the same pixel: with those of any two, cubes between one that hides and one
  // whose environment is farther away would stay in doubt, however small they are.
  const DepthWindows::Level& hidden = space.hidden_depth.levels[0];
  std::uint64_t reach = 0;
  visit_pixels(cubes, hidden.columns, [&](Ints places) HWY_ATTR {
    const Lanes from_m = metres_of(gather(hidden.least.data(), places));
    const Lanes front_m = ceiling_of_m(gather(left.levels[0].least.data(), places));
    reach |= bits_of(both(Lanes(cubes.zb) > from_m, Lanes(cubes.za) < front_m));
  });
  return reach;
}

/// The cubes some of whose points the view may hide.
HWY_INLINE std::uint64_t hides_some(const CameraSpace& space, const Projection& cubes) {
  std::uint64_t hides = 0;
  if (cubes.meets != 0) {
    hides = cubes.meets & bits_of(Lanes(cubes.zb) > least_of_m(space.hidden_depth, cubes));
    if (hides != 0 && space.has_environment) hides &= reach_before_environment(space, cubes);
  }
  if (cubes.through == 0) return hides;
  // Any pixel may see what reaches through the camera's plane.
  const DepthWindows::Level& all = space.hidden_depth.levels[space.hidden_depth.level_count - 1];
  return hides | (cubes.through & bits_of(Lanes(cubes.zb) > Lanes(in_metres(all.least[0]))));
}

/// The cubes all of whose points the view sees free.
HWY_INLINE std::uint64_t frees_all(const FreeingCamera& view, const Projection& cubes) {
  if (cubes.inside == 0) return 0;
  return cubes.inside & bits_of(Lanes(cubes.zb) < least_of_m(*view.free_depth, cubes));
}

/// The pixels of the first cube.
HWY_INLINE PixelRect first_rect(const Projection& cubes) {
  return {hn::GetLane(cubes.u0), hn::GetLane(cubes.v0), hn::GetLane(cubes.u1) + 1,
          hn::GetLane(cubes.v1) + 1};
}

/// What a view says of all of a cube at once, so that nobody need ask for its children.
struct WholeCube {
  bool hides_none = true;
  bool frees_none = true;
  bool frees_all = false;
};

HWY_INLINE WholeCube look_at_whole(const FreeingCamera& view, const Cube& cube) {
  WholeCube whole;
  const CameraSpace& space = *view.space;
  if (space.is_empty()) return whole;
  const auto half_m = static_cast<float>(cube.edge_m() / 2);
  const Eigen::Vector3f centre_m = (cube.corner_m().array() + cube.edge_m() / 2).cast<float>();
  const CubePoints centre{Lanes(centre_m.x()), Lanes(centre_m.y()), Lanes(centre_m.z())};
  const Projection seen = project(view, centre, centre_m.norm() + 2 * half_m, half_m);
  const float zb_m = hn::GetLane(seen.zb);
  whole.hides_none = (seen.through & 1) == 0;
  if ((seen.meets & 1) != 0) {
    const PixelRect rect = first_rect(seen);
    const bool is_in_front = !space.has_environment ||
                             hn::GetLane(seen.za) < greatest_of_m(space.environment_front, rect);
    const bool may_hide = zb_m > berth::least_of_m(space.hidden_depth, rect) && is_in_front;
    whole.hides_none = whole.hides_none && !may_hide;
  }
  whole.frees_none = view.free_depth == nullptr || (seen.meets & 1) == 0;
  whole.frees_all = !whole.frees_none && (seen.inside & 1) != 0 &&
                    zb_m < berth::least_of_m(*view.free_depth, first_rect(seen));
  return whole;
}

/// A cube whose children are asked for, and what each view says of all of it.
struct ParentCube {
  std::span<const FreeingCamera> views;
  WholeCube whole[UnknownSpace::kMostViews];
  float reach_m;
  float half_m;
};

/// Which of kLanes of its children may hold something hidden.
HWY_INLINE std::uint64_t possible_of(const ParentCube& parent, const CubePoints& centres) {
  const std::span<const FreeingCamera> views = parent.views;
  Projection cubes[UnknownSpace::kMostViews];
  std::uint64_t hides[UnknownSpace::kMostViews];
  std::uint64_t hidden_once = 0, hidden_twice = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const WholeCube& whole = parent.whole[k];
    hides[k] = 0;
    const bool asks_whether_free = !whole.frees_none && !whole.frees_all;
    if (whole.hides_none && !asks_whether_free) continue;
    cubes[k] = project(views[k], centres, parent.reach_m, parent.half_m);
    if (whole.hides_none) continue;
    hides[k] = hides_some(*views[k].space, cubes[k]);
    hidden_twice |= hidden_once & hides[k];
    hidden_once |= hides[k];
  }
  std::uint64_t freed[UnknownSpace::kMostViews] = {};
  std::uint64_t freed_once = 0, freed_twice = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    // What no other view hides, it need not free.
    const std::uint64_t by_others = hidden_twice | (hidden_once & ~hides[k]);
    if (by_others == 0 || parent.whole[k].frees_none) continue;
    freed[k] = parent.whole[k].frees_all ? ~std::uint64_t{0} : frees_all(views[k], cubes[k]);
    freed_twice |= freed_once & freed[k];
    freed_once |= freed[k];
  }
  std::uint64_t possible = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    // What another view frees: all that two do, or one that is not k.
    possible |= hides[k] & ~(freed_twice | (freed_once & ~freed[k]));
  }
  return possible;
}

std::uint64_t find(std::span<const FreeingCamera> views, const Cube& cube) {
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  ParentCube parent;
  parent.views = views;
  parent.reach_m = cube.corner_m().cast<float>().norm() + 4 * edge_m;
  parent.half_m = 0.5f * edge_m;
  bool hides_none = true;
  for (std::size_t k = 0; k < views.size(); ++k) {
    parent.whole[k] = look_at_whole(views[k], cube);
    hides_none = hides_none && parent.whole[k].hides_none;
  }
  if (hides_none) return 0;
  std::uint64_t possible = 0;
  for (int i = 0; i < 64; i += kLanes) possible |= possible_of(parent, child_centres(cube, i)) << i;
  return possible;
}

std::uint64_t find_in_no_image(std::span<const FreeingCamera> views,
                               std::span<const GuardedBox> guarded, const Cube& cube) {
  const auto edge_m = static_cast<float>(cube.edge_m() / 4);
  const float reach_m = cube.corner_m().cast<float>().norm() + 4 * edge_m;
  std::uint64_t outside = ~std::uint64_t{0};
  for (const FreeingCamera& view : views) {
    if (!view.free_depth) continue;
    for (int i = 0; i < 64; i += kLanes) {
      const Projection cubes = project(view, child_centres(cube, i), reach_m, 0.5f * edge_m);
      outside &= ~(cubes.inside << i);
    }
  }
  const double half_m = cube.edge_m() / 8;
  for (std::uint64_t left = guarded.empty() ? 0 : outside; left != 0; left &= left - 1) {
    const int i = __builtin_ctzll(left);
    const Eigen::Vector3d middle_B_m = cube.child(i).corner_m().array() + half_m;
    if (is_guarded(guarded, middle_B_m, half_m)) outside &= ~(std::uint64_t{1} << i);
  }
  return outside;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(find);
HWY_EXPORT(find_in_no_image);

std::uint64_t find_block(std::span<const FreeingCamera> views, const Cube& cube) {
  return HWY_DYNAMIC_DISPATCH(find)(views, cube);
}

std::uint64_t find_unobserved(std::span<const FreeingCamera> views,
                              std::span<const GuardedBox> guarded, const Cube& cube) {
  return HWY_DYNAMIC_DISPATCH(find_in_no_image)(views, guarded, cube);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
