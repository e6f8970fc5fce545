#pragma once

#include <filesystem>
#include <string>

#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// Reads the triangles of an STL, DAE or OBJ file (and whatever else Assimp knows by its ending,
/// which it then reads unchecked), in metres. As ROS tools do, the unit of a DAE is applied and its
/// up axis is not: the URDF's origin places the mesh as it was modelled. A glTF's y, which its
/// standard has up, becomes z. Throws std::runtime_error that names the file where it is missing,
/// unreadable, cut, without triangles, packed in a way that Assimp does not read, or holds a vertex
/// that is not finite.
TriangleMesh read_mesh_file(const std::filesystem::path& path);

/// A mesh as a binary STL, which read_mesh_file() reads again: each triangle with its unit normal
/// (0 where it has no area), in the mesh's own unit.
std::string stl_bytes(const TriangleMesh& mesh);

}  // namespace berth
