#include "apps/support/data_folders.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth::app {

namespace fs = std::filesystem;

fs::path bundled_scene_file() {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth/bundled",
                             fs::path(BERTH_SOURCE_DIR) / "data/bundled"};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / "scene.yaml")) return folder / "scene.yaml";
  }
  throw std::runtime_error(fmt::format("scene.yaml is not there; expected it in {} or {}",
                                       places[0].string(), places[1].string()));
}

}  // namespace berth::app
