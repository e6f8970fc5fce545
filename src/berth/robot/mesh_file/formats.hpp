// Inside robot/mesh_file/ only: what is read, or looked at, before Assimp has it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace berth {

/// Faces of three corners or more, each as indices of vertices counted from 0.
struct Polygons {
  std::vector<Eigen::Vector3f> vertices_m;
  std::vector<std::vector<std::uint32_t>> faces;
};

/// The vertices and faces of an OBJ; points, lines, materials and what else it holds are left out.
/// Assimp's own reader drops a vertex of a wrong length in silence, so that all later ones change
/// their numbers, follows a material file wherever it is, and fills 32 MiB for each file. Throws
/// std::runtime_error with file, line, value and what was expected: a coordinate that is no finite
/// number, a vertex without three of them, an index of no vertex, no face.
Polygons read_obj_polygons(const std::filesystem::path& path, const std::string& text);

/// The triangles of an STL, binary or text; its normals are left out, which some tools write as
/// -nan(ind). Read are words in capitals or as "end facet", and what stands behind the triangles
/// that a binary one's header counts, unless it is triangles too. Throws std::runtime_error with
/// file, line of a text, value and what was expected: an STL that was cut, a facet without three
/// corners, a coordinate that is no number.
Polygons read_stl_polygons(const std::filesystem::path& path, const std::string& bytes);

/// The geometry of a COLLADA file and the nodes that place it, without materials, animations and
/// what else berth has no use for. Refuses what Assimp would trust: its COLLADA reader allocates as
/// much as a count says, reads beyond arrays, and follows nodes that hold themselves until the
/// stack ends. Throws std::runtime_error with file, line, value and what was expected: XML that is
/// broken or nested too deep, a list of numbers that holds something else, a count above what the
/// file can hold, an accessor beyond its array, nodes that hold themselves or unfold to more than
/// 100 000.
std::string checked_collada(const std::filesystem::path& path, const std::string& text);

}  // namespace berth
