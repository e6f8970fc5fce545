#include "berth/visibility/line_of_sight.hpp"

#include <array>
#include <bit>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/visibility/sights.cpp"
#include "hwy/foreach_target.h"

#include "berth/vector/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {

struct LanePoints {
  Lanes x, y, z;
};

/// R p + t. Nothing is contracted, so that a point falls into one pixel on every instruction set.
HWY_INLINE LanePoints moved(const Eigen::Matrix3f& R, const LanePoints& p, const LanePoints& t) {
  const auto row = [&](int i) HWY_ATTR {
    return Lanes(R(i, 0)) * p.x + Lanes(R(i, 1)) * p.y + Lanes(R(i, 2)) * p.z;
  };
  return {row(0) + t.x, row(1) + t.y, row(2) + t.z};
}

HWY_INLINE LanePoints broadcast_point(const Eigen::Vector3f& p) {
  return {Lanes(p.x()), Lanes(p.y()), Lanes(p.z())};
}

HWY_INLINE LanePoints place(const PlacedPoints& points, int first) {
  LanePoints p_B = broadcast_point(points.origin_B_m);
  for (const PlacedPoints::Part& part : points.parts) {
    if (!part.points) continue;
    const auto& at_m = part.points->at_m;
    p_B = moved(part.turn, {load(&at_m[0][first]), load(&at_m[1][first]), load(&at_m[2][first])},
                p_B);
  }
  return p_B;
}

/// Where points fall into an image; those that do not take its first pixel.
struct ShownPoints {
  LaneMask is_inside;
  alignas(64) float u[kLanes];
  alignas(64) float v[kLanes];
};

HWY_INLINE ShownPoints show(const Camera& camera, const LanePoints& p_C) {
  const Lanes zero(0.0f), half(0.5f);
  const LaneMask is_before = p_C.z > zero;
  const Lanes depth = select(is_before, p_C.z, Lanes(1.0f));
  // Rounded to the nearest pixel: its border is at + 0.5.
  const auto at = [&](Lanes x, double focal_px, double centre_px) HWY_ATTR {
    return Lanes(static_cast<float>(focal_px)) * (x / depth) +
           Lanes(static_cast<float>(centre_px)) + half;
  };
  const Lanes u = at(p_C.x, camera.fx_px, camera.cx_px);
  const Lanes v = at(p_C.y, camera.fy_px, camera.cy_px);
  const Lanes width(static_cast<float>(camera.width_px));
  const Lanes height(static_cast<float>(camera.height_px));
  const LaneMask in_columns = both(u >= zero, u < width);
  const LaneMask in_rows = both(v >= zero, v < height);
  ShownPoints shown;
  shown.is_inside = both(is_before, both(in_columns, in_rows));
  store(select(shown.is_inside, u, zero), shown.u);
  store(select(shown.is_inside, v, zero), shown.v);
  return shown;
}

HWY_INLINE Lanes code(Sight sight) { return Lanes(static_cast<float>(sight)); }

/// What a pixel's fate says of a point that nothing stands before.
struct FateCodes {
  float sight[kPixelFateCount];
  /// 1 where the robot or its environment was.
  float is_robot[kPixelFateCount];

  explicit FateCodes(bool of_surface) {
    for (int i = 0; i < kPixelFateCount; ++i) {
      const auto fate = static_cast<PixelFate>(i);
      const bool was_robot = fate == PixelFate::robot || fate == PixelFate::environment;
      // Nobody saw the space before a background or what fills a hole.
      const bool was_seen =
          was_robot || fate == PixelFate::obstacle || (of_surface && is_kept(fate));
      sight[i] = static_cast<float>(was_seen ? Sight::seen : Sight::no_reading);
      is_robot[i] = was_robot ? 1.0f : 0.0f;
    }
  }
};

/// What one view knows of points with these places in its frame C.
template <bool of_surface>
HWY_INLINE Lanes sights_in(const SeeingCamera& view, const FateCodes& fates,
                           const LanePoints& p_C) {
  const SeenFrame& frame = view.frame;
  const ShownPoints shown = show(frame.camera, p_C);
  if (bits_of(shown.is_inside) == 0) return code(Sight::outside_image);
  alignas(64) float obstacle_m[kLanes], other_m[kLanes], fate_sight[kLanes], fate_robot[kLanes];
  for (int i = 0; i < kLanes; ++i) {
    const auto u = static_cast<int>(shown.u[i]);
    const auto v = static_cast<int>(shown.v[i]);
    const auto fate = static_cast<std::size_t>(frame.obstacles.fate.row(v)[u]);
    obstacle_m[i] = frame.obstacles.depth_m.row(v)[u];
    other_m[i] = of_surface ? in_metres(view.sensor_depth(u, v)) : frame.robot.depth_m.row(v)[u];
    fate_sight[i] = fates.sight[fate];
    fate_robot[i] = fates.is_robot[fate];
  }
  const auto least_reading = [&](Lanes z) HWY_ATTR {
    const Tolerance& t = frame.tolerance;
    return z - (Lanes(t.constant_m) + Lanes(t.per_m2) * z * z);
  };
  const Lanes other = load(other_m);
  const Lanes before = of_surface ? least_reading(p_C.z) : p_C.z;
  const LaneMask is_robot = both(load(fate_robot) > Lanes(0.0f),
                                 of_surface ? other < before : least_reading(other) <= before);
  Lanes sight = select(is_robot, code(Sight::hidden_by_robot), load(fate_sight));
  sight = select(load(obstacle_m) < before, code(Sight::hidden_by_obstacles), sight);
  if (of_surface) sight = select(other < Lanes(HUGE_VALF), sight, code(Sight::no_reading));
  return select(shown.is_inside, sight, code(Sight::outside_image));
}

/// Points that no view has seen yet, with what is known of them.
struct OpenPoints {
  static constexpr int kRoom = 2 * PointLanes::kMostLanes;

  int count = 0;
  std::array<std::array<float, kSamplePoints + kRoom>, 3> at_B_m;
  std::array<float, kSamplePoints + kRoom> best;

  HWY_INLINE LanePoints load_points(int first) const {
    return {load(&at_B_m[0][first]), load(&at_B_m[1][first]), load(&at_B_m[2][first])};
  }
  /// Appends those of `keep`, and writes over what lies behind them for as much as a vector. (Not
  /// by CompressStore, which takes some processors a hundred cycles.)
  HWY_INLINE void append(LaneMask keep, const LanePoints& p_B, Lanes sight) {
    store(hn::Compress(p_B.x.v, keep), &at_B_m[0][count]);
    store(hn::Compress(p_B.y.v, keep), &at_B_m[1][count]);
    store(hn::Compress(p_B.z.v, keep), &at_B_m[2][count]);
    store(hn::Compress(sight.v, keep), &best[count]);
    count += std::popcount(bits_of(keep));
  }
};

HWY_INLINE LaneMask first_lanes(int count) {
  return count_up(0.0f) < Lanes(static_cast<float>(count));
}

/// Leaves those points open that the view does not see.
template <bool of_surface>
HWY_INLINE void look_from(const SeeingCamera& view, const FateCodes& fates, OpenPoints& open) {
  const Eigen::Matrix3f R_CB = view.X_CB.linear().cast<float>();
  const LanePoints t_CB = broadcast_point(view.X_CB.translation().cast<float>());
  const int count = open.count;
  open.count = 0;
  for (int first = 0; first < count; first += kLanes) {
    const LanePoints p_B = open.load_points(first);
    const Lanes sight =
        least(load(&open.best[first]), sights_in<of_surface>(view, fates, moved(R_CB, p_B, t_CB)));
    const LaneMask is_open = both(first_lanes(count - first), sight > code(Sight::seen));
    open.append(is_open, p_B, sight);
  }
}

template <bool of_surface>
HWY_INLINE SightCount count_sights(std::span<const SeeingCamera> views,
                                   const PlacedPoints& points) {
  const FateCodes fates(of_surface);
  OpenPoints open;
  for (int first = 0; first < points.count; first += kLanes) {
    open.append(first_lanes(points.count - first), place(points, first),
                code(Sight::outside_image));
  }
  for (const SeeingCamera& view : views) look_from<of_surface>(view, fates, open);
  SightCount count;
  count.add(Sight::seen, points.count - open.count);
  for (int i = 0; i < open.count; ++i) count.add(static_cast<Sight>(open.best[i]));
  return count;
}

SightCount count_surface(std::span<const SeeingCamera> views, const PlacedPoints& points) {
  return count_sights<true>(views, points);
}

SightCount count_space(std::span<const SeeingCamera> views, const PlacedPoints& points) {
  return count_sights<false>(views, points);
}

/// Of those that lie in no image, the ones in a box count as seen.
int count_in_no_image(std::span<const SeeingCamera> views, std::span<const GuardedBox> guarded,
                      const PlacedPoints& points) {
  int count = 0;
  for (int first = 0; first < points.count; first += kLanes) {
    const LanePoints p_B = place(points, first);
    std::uint64_t outside = bits_of(first_lanes(points.count - first));
    for (const SeeingCamera& view : views) {
      if (outside == 0) break;
      const Eigen::Matrix3f R_CB = view.X_CB.linear().cast<float>();
      const LanePoints t_CB = broadcast_point(view.X_CB.translation().cast<float>());
      outside &= ~bits_of(show(view.frame.camera, moved(R_CB, p_B, t_CB)).is_inside);
    }
    if (outside != 0 && !guarded.empty()) {
      alignas(64) float at_m[3][kLanes];
      store(p_B.x, at_m[0]), store(p_B.y, at_m[1]), store(p_B.z, at_m[2]);
      for (std::uint64_t left = outside; left != 0; left &= left - 1) {
        const int i = std::countr_zero(left);
        const Eigen::Vector3d p_B_m(at_m[0][i], at_m[1][i], at_m[2][i]);
        if (is_guarded(guarded, p_B_m)) outside &= ~(std::uint64_t{1} << i);
      }
    }
    count += std::popcount(outside);
  }
  return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(count_surface);
HWY_EXPORT(count_space);
HWY_EXPORT(count_in_no_image);

SightCount count_surface_sights(std::span<const SeeingCamera> views, const PlacedPoints& points) {
  return HWY_DYNAMIC_DISPATCH(count_surface)(views, points);
}

SightCount count_space_sights(std::span<const SeeingCamera> views, const PlacedPoints& points) {
  return HWY_DYNAMIC_DISPATCH(count_space)(views, points);
}

int count_unobserved(std::span<const SeeingCamera> views, std::span<const GuardedBox> guarded,
                     const PlacedPoints& points) {
  return HWY_DYNAMIC_DISPATCH(count_in_no_image)(views, guarded, points);
}

}  // namespace berth
#endif  // HWY_ONCE
