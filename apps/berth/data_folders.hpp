#pragma once

#include <filesystem>

namespace berth {

/// What comes with the program: beside an installed one, or in the source tree of one that was only
/// built. Each throws std::runtime_error where it is in neither place.
std::filesystem::path bundled_scene_file();
/// The folder of the scripts that draw the study's figures.
std::filesystem::path study_scripts_folder();

}  // namespace berth
