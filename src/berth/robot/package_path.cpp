#include "berth/robot/package_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <vector>

namespace berth {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::string_view kFile = "file://";

fs::path find_package(const std::string& package, const std::string& name,
                      const fs::path& urdf_folder,
                      const std::map<std::string, fs::path>& package_paths) {
  if (const auto known = package_paths.find(package); known != package_paths.end())
    return known->second;
  for (fs::path folder = urdf_folder;; folder = folder.parent_path()) {
    if (fs::is_directory(folder / package)) return folder / package;
    if (folder == folder.parent_path()) break;
  }
  std::vector<std::string> known;
  for (const auto& [key, path] : package_paths) known.push_back(key);
  throw std::runtime_error(fmt::format(
      "mesh \"{}\": package \"{}\" is not known; expected one of package_paths [{}] or a folder of "
      "that name in {} or above it",
      name, package, fmt::join(known, ", "), urdf_folder.string()));
}

}  // namespace

fs::path resolve_mesh_path(const std::string& name, const fs::path& urdf,
                           const std::map<std::string, fs::path>& package_paths) {
  if (name.find("$(") != std::string::npos || name.find("${") != std::string::npos) {
    throw std::runtime_error(fmt::format(
        "mesh \"{}\": is written for xacro; expected a URDF, such as xacro {} > robot.urdf makes",
        name, urdf.filename().string()));
  }
  const fs::path urdf_folder = fs::absolute(urdf).lexically_normal().parent_path();
  if (name.rfind(kPackage, 0) == 0) {
    const std::string rest = name.substr(kPackage.size());
    const auto slash = rest.find('/');
    if (slash == std::string::npos || slash == 0) {
      throw std::runtime_error(fmt::format("mesh \"{}\": expected package://NAME/PATH", name));
    }
    return find_package(rest.substr(0, slash), name, urdf_folder, package_paths) /
           rest.substr(slash + 1);
  }
  if (name.rfind(kFile, 0) == 0) return name.substr(kFile.size());
  if (name.find("://") != std::string::npos) {
    throw std::runtime_error(
        fmt::format("mesh \"{}\": expected package://NAME/PATH, file://PATH or a path", name));
  }
  return (urdf_folder / name).lexically_normal();
}

}  // namespace berth
