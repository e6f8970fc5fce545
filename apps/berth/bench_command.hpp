#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

#include "apps/berth/backend_arguments.hpp"

namespace berth {

struct BenchArguments {
  bool quick = false;
  int random_scenes = 200;
  std::filesystem::path out_folder;
  std::vector<std::filesystem::path> scenes;
  BackendArguments where;
};

void add_bench_options(CLI::App& command, BenchArguments& arguments);

/// Measures berth beside what else a user could take. Throws std::runtime_error where this berth
/// was built without benchmarks, a scene cannot be read, or the folder not be written; Interrupted
/// where the user stopped it.
void bench_command(const BenchArguments& arguments);

}  // namespace berth
