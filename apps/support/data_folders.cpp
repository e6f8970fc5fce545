#include "apps/support/data_folders.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth::app {

namespace fs = std::filesystem;

namespace {

fs::path data_file(const char* name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth",
                             fs::path(BERTH_SOURCE_DIR) / "data"};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / name)) return folder / name;
  }
  throw std::runtime_error(fmt::format("{} is not there; expected it in {} or {}", name,
                                       places[0].string(), places[1].string()));
}

}  // namespace

fs::path bundled_scene_file() { return data_file("bundled/scene.yaml"); }

fs::path bundled_one_camera_file() { return data_file("bundled/one_camera.yaml"); }

fs::path scene_schema_file() { return data_file("schema/scene.json"); }

}  // namespace berth::app
