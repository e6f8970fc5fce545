#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "apps/berth/backend_arguments.hpp"

namespace berth {

struct StudyArguments {
  bool quick = false;
  std::uint32_t seed = 1;
  std::filesystem::path out_folder = "berth_study";
  std::vector<std::filesystem::path> scenes;
  /// 0: as many as there are processors.
  int threads = 0;
  BackendArguments where;
};

void add_study_options(CLI::App& command, StudyArguments& arguments);

/// Throws as run_study does.
void study_command(const StudyArguments& arguments);

}  // namespace berth
