#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace berth::lab {

struct StudySettings {
  /// A thinned sweep of everything in less than a minute.
  bool quick = false;
  std::uint32_t seed = 1;
  int threads = 1;
  std::filesystem::path out_folder;
  /// The scene that comes with berth.
  std::filesystem::path bundled_scene;
  /// More scene files.
  std::vector<std::filesystem::path> scenes;
  /// The folder of make_page.py.
  std::filesystem::path scripts_folder;
  /// Measures the methods on OpenGL as well, on this device as GlContext takes it.
  std::optional<std::string> gl_device;
};

/// The thesis's experiments (Hirt 3.2): sweeps, then has the figures and the page made. Goes on
/// with a study of the same settings that was stopped. Throws std::runtime_error where Python or
/// matplotlib is missing (before anything is measured), a scene cannot be read, or the folder not
/// be written or is that of another study; GlUnavailable where there is no such device; Interrupted
/// where the user stopped it.
void run_study(const StudySettings& settings);

}  // namespace berth::lab
