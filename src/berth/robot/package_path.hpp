#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace berth {

/// The file that a mesh's name in a URDF means: package://NAME/..., model://NAME/..., file://...,
/// an absolute path, or one relative to the URDF's folder. Throws std::runtime_error where the
/// package is not known, or a URL or absolute path leads to no file here, nor by package_paths.
std::filesystem::path resolve_mesh_path(
    const std::string& name, const std::filesystem::path& urdf,
    const std::map<std::string, std::filesystem::path>& package_paths);

}  // namespace berth
