#include "apps/berth/data_folders.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace berth {
namespace {

namespace fs = std::filesystem;

/// The file in the folder of this name under share/berth, or in `source_folder`.
fs::path find_file(const fs::path& name, const fs::path& source_folder, const char* file) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path places[] = {program.parent_path().parent_path() / "share/berth" / name,
                             fs::path(BERTH_SOURCE_DIR) / source_folder};
  for (const fs::path& folder : places) {
    if (fs::is_regular_file(folder / file)) return folder / file;
  }
  throw std::runtime_error(fmt::format("{} is not there; expected it in {} or {}", file,
                                       places[0].string(), places[1].string()));
}

}  // namespace

fs::path bundled_scene_file() { return find_file("bundled", "data/bundled", "scene.yaml"); }

fs::path study_scripts_folder() {
  return find_file("study", "study", "make_page.py").parent_path();
}

}  // namespace berth
