// Inside record/ only: meshes as binary PLY files, which keep indices and every bit of a vertex.
#pragma once

#include <string>
#include <string_view>

#include "berth/robot/triangle_mesh.hpp"

namespace berth {

std::string ply_of(const TriangleMesh& mesh);

/// Of what ply_of() wrote. Throws std::runtime_error that says what is wrong.
TriangleMesh mesh_of_ply(std::string_view bytes);

}  // namespace berth
