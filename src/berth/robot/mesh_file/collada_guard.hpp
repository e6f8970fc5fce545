// Inside robot/mesh_file/ only.
#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// The geometry of a COLLADA file and the nodes that place it, without materials, animations and
/// what else berth has no use for. Refuses what Assimp would trust: its COLLADA reader allocates as
/// much as a count says, reads beyond arrays, and follows nodes that hold themselves until the
/// stack ends. Throws std::runtime_error with file, line, value and what was expected: XML that is
/// broken or nested too deep, a list of numbers that holds something else, a count above what the
/// file can hold, an accessor beyond its array, nodes that hold themselves or unfold to more than
/// 100 000.
std::string checked_collada(const std::filesystem::path& path, const std::string& text);

}  // namespace berth
