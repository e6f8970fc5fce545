// Inside robot/ only.
#pragma once

#include <filesystem>
#include <string>

namespace berth {

/// The vertices and faces of an OBJ alone, each face as indices of vertices counted from 1: the
/// rest is nothing to berth, and Assimp reads it carelessly (it drops a vertex of a wrong length
/// in silence, so that all later ones change their numbers; it follows a material file wherever it
/// is). Throws std::runtime_error with file, line, value and what was expected: a coordinate that
/// is no finite number, a vertex without three of them, an index of no vertex, no face.
std::string checked_obj(const std::filesystem::path& path, const std::string& text);

}  // namespace berth
