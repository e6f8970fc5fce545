#include "berth/robot/package_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>
#include <stdexcept>
#include <vector>

namespace berth {
namespace {

namespace fs = std::filesystem;

using PackagePaths = std::map<std::string, fs::path>;

// From urdf/ up to the src/ of a workspace, and one more.
constexpr std::size_t kMostFoldersToSearch = 5;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// A folder may have another name than its package.
bool is_package(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  pugi::xml_document manifest;
  return fs::is_regular_file(folder / "package.xml", ignored) &&
         manifest.load_file((folder / "package.xml").c_str()) &&
         manifest.document_element().child_value("name") == name;
}

/// A folder of that name that has the file, nearest first, there or where colcon installs it; else
/// one whose package.xml has that name.
fs::path find_package(const std::string& package, const std::string& file, const std::string& name,
                      const fs::path& urdf_folder, const PackagePaths& package_paths) {
  if (const auto known = package_paths.find(package); known != package_paths.end())
    return known->second;
  std::vector<fs::path> above{urdf_folder};
  while (above.back().has_relative_path()) above.push_back(above.back().parent_path());
  fs::path nearest;
  for (const fs::path& folder : above) {
    for (const fs::path& named : {folder / package, folder / package / "share" / package}) {
      if (is_there(named / file)) return named;
      if (nearest.empty() && is_there(named)) nearest = named;
    }
  }
  for (const fs::path& folder : above)
    if (is_package(folder, package)) return folder;
  above.resize(std::min(above.size(), kMostFoldersToSearch));
  for (const fs::path& folder : above) {
    std::error_code ignored;
    for (fs::directory_iterator at(folder, ignored), end; at != end; at.increment(ignored))
      if (is_package(at->path(), package)) return at->path();
  }
  if (!nearest.empty()) return nearest;
  std::vector<std::string> known;
  for (const auto& [key, path] : package_paths) known.push_back(key);
  throw std::runtime_error(fmt::format(
      "mesh \"{}\": package \"{}\" is not known; expected one of package_paths [{}] or a folder of "
      "that name, or whose package.xml has it, in {} or above it",
      name, package, fmt::join(known, ", "), urdf_folder.string()));
}

/// The file, or where package_paths say that its package is on this machine.
fs::path on_this_machine(const fs::path& file, const PackagePaths& package_paths) {
  if (is_there(file)) return file;
  for (const auto& [package, folder] : package_paths) {
    const std::string inside = "/" + package + "/";
    if (const auto at = file.string().rfind(inside); at != std::string::npos)
      return folder / file.string().substr(at + inside.size());
  }
  throw std::runtime_error(fmt::format(
      "{}: No such file; expected one, or its package's folder on this computer in the robot's "
      "package_paths, such as {{{}: FOLDER}}",
      file.string(), file.parent_path().parent_path().filename().string()));
}

/// %20 is a blank in a URL.
std::string decoded(const std::string& url) {
  std::string text;
  for (std::size_t i = 0; i < url.size(); ++i) {
    int code = url[i];
    const char* const digits = url.c_str() + i + 1;
    if (code == '%' && url.size() > i + 2 &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
      i += 2;
    text += static_cast<char>(code);
  }
  return text;
}

}  // namespace

fs::path resolve_mesh_path(const std::string& name, const fs::path& urdf,
                           const PackagePaths& package_paths) {
  if (name.find("$(") != std::string::npos || name.find("${") != std::string::npos) {
    throw std::runtime_error(
        fmt::format("mesh \"{}\": is written for xacro; expected a URDF, such as xacro {} -o "
                    "expanded.urdf makes: "
                    "name that one in its place",
                    name, urdf.filename().string()));
  }
  const fs::path urdf_folder = fs::absolute(urdf).lexically_normal().parent_path();
  const auto scheme_end = name.find("://");
  const std::string scheme = scheme_end == std::string::npos ? "" : name.substr(0, scheme_end);
  if (scheme.empty()) {
    const fs::path file = (urdf_folder / name).lexically_normal();
    return fs::path(name).is_absolute() ? on_this_machine(file, package_paths) : file;
  }
  const std::string rest = decoded(name.substr(scheme_end + 3));
  const auto slash = rest.find('/');
  if (scheme == "file")
    return on_this_machine(urdf_folder / rest.substr(rest.starts_with("localhost/") ? slash : 0),
                           package_paths);
  if ((scheme != "package" && scheme != "model") || slash == std::string::npos || slash == 0) {
    throw std::runtime_error(
        fmt::format("mesh \"{}\": expected package://NAME/PATH, file://PATH or a path", name));
  }
  const std::string file = rest.substr(slash + 1);
  return find_package(rest.substr(0, slash), file, name, urdf_folder, package_paths) / file;
}

}  // namespace berth
