// Inside space/ only: which children of a cube may be occupied or unknown.
#pragma once

#include <span>

#include "berth/space/cubes.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth::mesh {

/// The children of a cube that may hold an occupied point (D4), one bit each: a pixel that a child
/// projects into has F <= z <= F + t for some depth z in the child. Where that would be very many
/// pixels, right before a camera, they all may.
std::uint64_t find_occupied(std::span<const FreeingCamera> views, const Cube& cube);

/// The children of a cube that may hold a hidden point, one bit each. A child's box in a camera's
/// frame projects into a rectangle of pixels and depths [za, zb]. Nothing in it is hidden by k if
/// zb <= least H there, or za >= greatest environment front there; all of it is seen free by j if
/// the rectangle lies in j's image and zb < least E.
std::uint64_t find_block(std::span<const FreeingCamera> views, const Cube& cube);

/// The children of a cube that may hold a point that is in no view's image and in no guarded box.
/// None does that lies in one image as a whole.
std::uint64_t find_unobserved(std::span<const FreeingCamera> views,
                              std::span<const GuardedBox> guarded, const Cube& cube);

}  // namespace berth::mesh
