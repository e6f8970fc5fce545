// Inside robot/ only.
#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// Refuses what Assimp would take in part: an STL that was cut, a facet without three corners, a
/// word that is no number. `bytes` is the whole file. Throws std::runtime_error with file, line of
/// a text, value and what was expected.
void require_whole_stl(const std::filesystem::path& path, const std::string& bytes);

}  // namespace berth
