// What the robot carries, as files beside a new scene.
#pragma once

#include <filesystem>

#include "berth/calibration/attached_parts.hpp"
#include "berth/scene/rewrite_scene.hpp"

namespace berth {

/// NEW.attached.NAME.stl beside NEW.yaml.
std::filesystem::path attached_file(const std::filesystem::path& new_file,
                                    const AttachedPart& part);

/// Adds the parts that were taken to what the new scene says. Throws std::runtime_error that names
/// the file where its mesh would be one that the scene itself names. Writes nothing.
void attach_parts(const std::filesystem::path& scene_file, const AttachedParts& parts,
                  const std::filesystem::path& new_file, SceneChange& change);

/// Their meshes, in the links' frames. Each file is complete afterwards, or as it was before.
/// Throws std::runtime_error where one cannot be written.
void write_attached_parts(const AttachedParts& parts, const std::filesystem::path& new_file);

}  // namespace berth
