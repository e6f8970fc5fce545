#include "lab/trust/trial_robots.hpp"

#include <algorithm>

namespace berth::lab {

TrialRobot load_bundled_robot() {
  const std::filesystem::path folder = BERTH_BUNDLED_ARM;
  return make_trial_robot("bundled arm", load_robot({.urdf = folder / "arm.urdf",
                                                     .package_paths = {{"berth_arm", folder}},
                                                     .environment_links = {"table"}}));
}

std::vector<TrialRobot> load_trial_robots(const std::filesystem::path& robots_folder) {
  std::vector<std::filesystem::path> urdfs;
  if (!robots_folder.empty()) {
    for (const auto& folder : std::filesystem::directory_iterator(robots_folder)) {
      if (!folder.is_directory()) continue;
      for (const auto& file : std::filesystem::directory_iterator(folder)) {
        if (file.path().extension() == ".urdf") urdfs.push_back(file.path());
      }
    }
  }
  std::sort(urdfs.begin(), urdfs.end());
  std::vector<TrialRobot> robots;
  robots.push_back(load_bundled_robot());
  for (const auto& urdf : urdfs) {
    const std::string name = urdf.parent_path().filename().string() + "/" + urdf.stem().string();
    robots.push_back(make_trial_robot(name, load_robot({.urdf = urdf})));
  }
  return robots;
}

}  // namespace berth::lab
