#pragma once

#include <filesystem>

namespace berth::app {

/// The scene that comes with berth: beside an installed program, or in the source tree of one that
/// was only built. Throws std::runtime_error where it is in neither place.
std::filesystem::path bundled_scene_file();

}  // namespace berth::app
