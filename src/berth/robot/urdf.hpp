// Inside robot/ only: the URDF's text, parsed and checked to be one tree.
#pragma once

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <filesystem>
#include <string>

namespace berth {

/// Throws std::runtime_error that names the file and the trouble. The result has exactly one root,
/// every link hangs on it by exactly one joint, and mimic chains end at a joint that moves.
urdf::ModelInterfaceSharedPtr parse_urdf(const std::filesystem::path& path,
                                         const std::string& text);

/// The text of a file. Throws std::runtime_error where it cannot be read.
std::string read_urdf(const std::filesystem::path& path);

}  // namespace berth
