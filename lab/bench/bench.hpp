#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace berth::lab {

struct BenchSettings {
  /// A thinned run of less than half a minute.
  bool quick = false;
  /// Of a run that is not thinned.
  int random_scenes = 200;
  /// Scenes for the whole robot in a run that is not thinned.
  int whole_robot_scenes = 100;
  /// Only the tables of the whole robot.
  bool whole_robot_alone = false;
  /// Folder for results.md and whole_robot.md; none: the tables are only printed.
  std::filesystem::path out_folder;
  /// The scene that comes with berth.
  std::filesystem::path bundled_scene;
  /// More scene files, each a table of its own.
  std::vector<std::filesystem::path> scenes;
  /// Measures the methods on OpenGL instead of those on the processor, on this device as GlContext
  /// takes it.
  std::optional<std::string> gl_device;
};

/// Measures everything and prints the tables as they come. Throws std::runtime_error where a scene
/// cannot be read or the folder not be written, GlUnavailable where there is no such device.
void run_benchmarks(const BenchSettings& settings);

}  // namespace berth::lab
