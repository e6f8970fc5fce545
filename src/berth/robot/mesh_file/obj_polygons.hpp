// Inside robot/mesh_file/ only.
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

}  // namespace berth
