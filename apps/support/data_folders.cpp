#include "apps/support/data_folders.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth::app {

namespace fs = std::filesystem;

namespace {

fs::path bundled_file(const char* name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth/bundled",
                             fs::path(BERTH_SOURCE_DIR) / "data/bundled"};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  throw std::runtime_error(fmt::format("{} is not there; expected it in {} or {}", name,
                                       places[0].string(), places[1].string()));
}

}  // namespace

fs::path bundled_scene_file() { return bundled_file("scene.yaml"); }

fs::path bundled_one_camera_file() { return bundled_file("one_camera.yaml"); }

}  // namespace berth::app
