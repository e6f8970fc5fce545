// What the searches among cubes of unknown space know of their items.
#pragma once

#include "berth/distance/link_search.hpp"
#include "berth/space/cubes.hpp"

namespace berth::mesh {

/// Marks a cube in Item::patch of which some children are gone. Item::way is the request of which
/// an item's bound is that of its own corners, not of the cube that it is a child of.
inline constexpr std::uint32_t kOpened = 1u << 31;

/// The level from which on down a cube's corners tell more than patches do.
inline constexpr int kGreatestByCorners = 4;

/// No point that a search asks for is farther from the origins of both frames.
inline float reach_of_cubes_m(const LinkSearch& search) {
  const PatchLevel& top = search.link->levels.back();
  const Eigen::Vector3d centre_L_m(top.centre_m[0][0], top.centre_m[1][0], top.centre_m[2][0]);
  return static_cast<float>(centre_L_m.norm() + search.X_BL.translation().norm()) +
         top.half_height_m[0] + top.radius_m[0] + search.known_range_m();
}

}  // namespace berth::mesh
