// Figures and page are made by Python, by the scripts of this folder.
#pragma once

#include <filesystem>

namespace berth::lab {

/// Throws std::runtime_error, naming what to install, where Python or matplotlib is missing.
void require_page_program();

/// Makes figure_3_05.csv, .svg, .png, ... and index.html from what a journal left in the folder.
/// Throws std::runtime_error where that fails; the script's message is on standard error then.
void make_page(const std::filesystem::path& scripts_folder,
               const std::filesystem::path& study_folder);

}  // namespace berth::lab
