#pragma once

#include <filesystem>

namespace berth::app {

/// The scene that comes with berth, with all its cameras: beside an installed program, or in the
/// source tree of one that was only built. Throws std::runtime_error where it is in neither place.
std::filesystem::path bundled_scene_file();

/// The same with its first camera alone, for the methods that know one image.
std::filesystem::path bundled_one_camera_file();

/// What `berth schema scene` writes, in the same places. Throws as the others do.
std::filesystem::path scene_schema_file();

}  // namespace berth::app
