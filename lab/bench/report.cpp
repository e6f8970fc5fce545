#include "lab/bench/report.hpp"

#include <fcl/config.h>
#include <fmt/format.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <cstdio>
#include <nanoflann.hpp>
#include <stdexcept>

#include "lab/measure/instruction_set.hpp"
#include "lab/measure/machine.hpp"
#include "sim/embree.hpp"

namespace berth::lab {
namespace {

/// What the figures depend on, one "name: value" a line.
std::vector<std::string> describe_machine() {
  return {
      fmt::format("processor: {}", processor_name()),
      fmt::format("instruction set: {}", best_instruction_set()),
      "times: of methods with one thread, its processor time; of the method with two threads, of "
      "stages and of meshes, by the clock on the wall",
      fmt::format("compiler: {}", compiler_name()),
      fmt::format("libraries: Highway {}, Embree {}, Eigen {}.{}.{}, TBB {}.{}, nanoflann {:x}, "
                  "FCL {}, OctoMap {}.{}.{}",
                  BERTH_BENCH_HIGHWAY, RTC_VERSION_STRING, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                  EIGEN_MINOR_VERSION, TBB_VERSION_MAJOR, TBB_VERSION_MINOR, NANOFLANN_VERSION,
                  FCL_VERSION, OCTOMAP_MAJOR_VERSION, OCTOMAP_MINOR_VERSION, OCTOMAP_PATCH_VERSION),
      fmt::format("commit: {}", commit_name()),
  };
}

void require(const std::ofstream& stream, const std::filesystem::path& file) {
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace

Report::Report(const std::filesystem::path& folder, const std::string& gl_renderer,
               const std::string& file_name) {
  std::vector<std::string> machine = describe_machine();
  if (!gl_renderer.empty()) machine.push_back("OpenGL: " + gl_renderer);
  for (const std::string& line : machine) fmt::print("{}\n", line);
  fmt::print("\n");
  std::fflush(stdout);
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  file_ = folder / file_name;
  markdown_.open(file_);
  for (const std::string& line : machine) markdown_ << "- " << line << '\n';
  require(markdown_, file_);
}

void Report::add(const Table& table) {
  fmt::print("{}\n", text_of(table));
  std::fflush(stdout);
  if (file_.empty()) return;
  markdown_ << '\n' << markdown_of(table) << std::flush;
  require(markdown_, file_);
}

}  // namespace berth::lab
