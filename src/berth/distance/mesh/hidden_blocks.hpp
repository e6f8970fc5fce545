#pragma once

#include <span>

#include "berth/distance/mesh/cubes.hpp"
#include "berth/distance/mesh/hidden_space.hpp"

namespace berth::mesh {

/// What the children of a cube hold. A child's box in a camera's frame projects into a rectangle
/// of pixels and depths [za, zb]. Nothing in it is hidden by k if zb <= least F there + t; all of
/// it is if za > greatest F + t and all pixels have readings. All of it is seen free by j if the
/// rectangle lies in j's image and zb < least E; nothing if za >= greatest E.
CubeBlock find_block(std::span<const CarvingView> views, const Cube& cube);

}  // namespace berth::mesh
