#pragma once

#include <filesystem>
#include <vector>

namespace berth::bench {

struct BenchSettings {
  /// A thinned run of less than half a minute.
  bool quick = false;
  /// Of a run that is not thinned.
  int random_scenes = 200;
  /// Folder for bench.csv and results.md; none: the tables are only printed.
  std::filesystem::path out_folder;
  /// The scene that comes with berth.
  std::filesystem::path bundled_scene;
  /// More scene files, each a table of its own.
  std::vector<std::filesystem::path> scenes;
};

/// Measures everything and prints the tables as they come. Throws std::runtime_error where a scene
/// cannot be read or the folder not be written.
void run_benchmarks(const BenchSettings& settings);

}  // namespace berth::bench
