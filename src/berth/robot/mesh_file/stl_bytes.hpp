#pragma once

#include <string>

#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// A mesh as a binary STL, which read_mesh_file() reads again: each triangle with its unit normal
/// (0 where it has no area), in the mesh's own unit.
std::string stl_bytes(const TriangleMesh& mesh);

}  // namespace berth
