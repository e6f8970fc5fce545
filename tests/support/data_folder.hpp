#pragma once

#include <cstdlib>
#include <filesystem>

namespace berth {

/// Real robots and recordings: other people's work, so not in this repository. A test that needs
/// them is skipped where the folder is missing. Environment variable BERTH_DATA overrides the
/// place.
inline std::filesystem::path data_folder() {
  const char* set = std::getenv("BERTH_DATA");
  return set != nullptr ? set : BERTH_DATA_DEFAULT;
}

}  // namespace berth
