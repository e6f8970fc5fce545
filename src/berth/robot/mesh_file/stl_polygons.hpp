// Inside robot/mesh_file/ only.
#pragma once

#include <filesystem>
#include <string>

#include "berth/robot/mesh_file/obj_polygons.hpp"

namespace berth {

/// The triangles of an STL, binary or text; its normals are left out, which some tools write as
/// -nan(ind). Read are words in capitals or as "end facet", and what stands behind the triangles
/// that a binary one's header counts, unless it is triangles too. Throws std::runtime_error with
/// file, line of a text, value and what was expected: an STL that was cut, a facet without three
/// corners, a coordinate that is no number.
Polygons read_stl_polygons(const std::filesystem::path& path, const std::string& bytes);

}  // namespace berth
