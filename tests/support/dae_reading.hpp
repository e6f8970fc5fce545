#pragma once

#include <filesystem>

#include "tests/support/mesh_reading.hpp"

namespace berth {

/// The triangles of a COLLADA file's visual scene, in metres: node transforms and the unit applied,
/// the up axis not. Knows matrix, translate, rotate, scale, instance_geometry, triangles, polylist
/// and polygons; throws std::runtime_error that names the file at another transform or instance.
TriangleSoup read_dae(const std::filesystem::path& path);

}  // namespace berth
