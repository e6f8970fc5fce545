// Inside robot/mesh_file/ only.
#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// The bytes of an STL with all normals of a text set to 0: berth has no use for them, some tools
/// write -nan(ind), and Assimp leaks memory at one that is no number. Refuses what Assimp would
/// take in part: an STL that was cut, a facet without three corners, a coordinate that is no
/// number. Throws std::runtime_error with file, line of a text, value and what was expected.
std::string checked_stl(const std::filesystem::path& path, std::string bytes);

}  // namespace berth
