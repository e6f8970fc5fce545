// A second, independent reading of mesh files: short code of its own, so that a mistake of the
// library that src/berth uses for them shows in a test.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace berth {

/// The corners of each triangle.
using TriangleSoup = std::vector<std::array<Eigen::Vector3d, 3>>;

/// The triangles of an STL, OBJ or DAE file in metres, polygons cut into fans. As in ROS, the unit
/// of a DAE is applied and its up axis is not. Throws std::runtime_error that names the file.
TriangleSoup read_triangles(const std::filesystem::path& path);

/// The bytes of a file. Throws std::runtime_error that names it.
std::string read_bytes(const std::filesystem::path& path);

/// Appends the polygon as a fan around its first corner.
void append_fan(const std::vector<Eigen::Vector3d>& polygon, TriangleSoup& soup);

}  // namespace berth
