#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "apps/berth/commands.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// Beside an installed program, or in the source tree of a program that was only built.
fs::path find_bundled_scene() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth/bundled",
                             BERTH_BUNDLED_SCENE};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / "scene.yaml")) return folder / "scene.yaml";
  }
  throw std::runtime_error(
      fmt::format("the bundled scene is not there; expected scene.yaml in {} or {}",
                  places[0].string(), places[1].string()));
}

}  // namespace

void demo_command(const DemoArguments& arguments) {
  RunArguments run;
  run.scene = find_bundled_scene();
  run.picture_folder = arguments.picture_folder;
  run.threads = arguments.threads;
  run_command(run);
  fmt::print("The pictures are in {}\n",
             fs::absolute(arguments.picture_folder).lexically_normal().string());
}

}  // namespace berth
