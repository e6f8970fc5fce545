// How near a link is to the children of great cubes, by the patches that it consists of.
#if defined(BERTH_MESH_TOP_PATCHES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BERTH_MESH_TOP_PATCHES_INL_HPP
#undef BERTH_MESH_TOP_PATCHES_INL_HPP
#else
#define BERTH_MESH_TOP_PATCHES_INL_HPP
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "berth/distance/patches-inl.hpp"
#include "berth/space/children-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {

/// The link's patches of the finest level that has no more than kMost, in B.
struct TopPatches {
  static constexpr int kMost = 32;

  /// Of each: centre, axis, half height, radius.
  alignas(64) float numbers[8][kMost + kLanes];
  int count = 0;

  TopPatches(const LinkPatches& link, const Pose& X_BL) {
    std::size_t level = 0;
    while (link.levels[level].count > kMost) ++level;
    count = link.levels[level].count;
    const Motion motion = motion_of(X_BL);
    for (int k = 0; k < count; k += kLanes) {
      const Patches patches = load_patches(link.levels[level], k, motion);
      const Lanes all[] = {patches.centre.x, patches.centre.y, patches.centre.z,    patches.axis.x,
                           patches.axis.y,   patches.axis.z,   patches.half_height, patches.radius};
      for (int i = 0; i < 8; ++i) store(all[i], numbers[i] + k);
    }
  }

  Patches many(int k) const {
    return {{load(numbers[0] + k), load(numbers[1] + k), load(numbers[2] + k)},
            {load(numbers[3] + k), load(numbers[4] + k), load(numbers[5] + k)},
            load(numbers[6] + k),
            load(numbers[7] + k)};
  }
};

/// The same patch in every lane.
HWY_INLINE Patches broadcast_patch(const TopPatches& patches, int k) {
  const auto& f = patches.numbers;
  return {{Lanes(f[0][k]), Lanes(f[1][k]), Lanes(f[2][k])},
          {Lanes(f[3][k]), Lanes(f[4][k]), Lanes(f[5][k])},
          Lanes(f[6][k]),
          Lanes(f[7][k])};
}

/// Great cubes are far from being like their corners: the cylinders of the link's patches bound the
/// distances of their children, where they are below limit_m; error_m is what roundings may add up
/// to.
HWY_INLINE void bound_by_patches(const TopPatches& patches, const Cube& cube, std::uint64_t wanted,
                                 float limit_m, float error_m, float (&out_m)[64]) {
  const auto edge_m = static_cast<float>(cube.edge_m());
  const Eigen::Vector3f middle_m = (cube.corner_m().array() + cube.edge_m() / 2).cast<float>();
  const Boxes whole{{Lanes(middle_m.x()), Lanes(middle_m.y()), Lanes(middle_m.z())},
                    Lanes(edge_m / 2)};
  alignas(64) float of_whole_m[TopPatches::kMost + kLanes];
  Lanes nearest(HUGE_VALF);
  for (int k = 0; k < patches.count; k += kLanes) {
    const Lanes bound = patch_bound(patches.many(k), whole);
    store(bound, of_whole_m + k);
    nearest = least(nearest, bound);
  }
  // Farther than this from all of the cube, a patch is not the nearest of any child.
  const float beyond_m = std::min(limit_m + error_m, least_lane(nearest) + 2 * edge_m);
  float others_m = HUGE_VALF;
  int near[TopPatches::kMost], count = 0;
  for (int k = 0; k < patches.count; ++k) {
    if (of_whole_m[k] < beyond_m) {
      near[count++] = k;
    } else {
      others_m = std::min(others_m, of_whole_m[k]);
    }
  }
  for (int i = 0; i < 64; i += kLanes) {
    if (!has_wanted(wanted, i)) continue;
    const CubePoints centre = child_centres(cube, i);
    const Boxes boxes{{centre.x, centre.y, centre.z}, Lanes(edge_m / 8)};
    Lanes bound(others_m);
    for (int j = 0; j < count; ++j) {
      bound = least(bound, patch_bound(broadcast_patch(patches, near[j]), boxes));
    }
    store(bound - Lanes(error_m), out_m + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#endif
