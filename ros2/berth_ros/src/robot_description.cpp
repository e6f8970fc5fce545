#include "robot_description.hpp"

#include <ament_index_cpp/get_package_prefix.hpp>
#include <ament_index_cpp/get_package_share_directory.hpp>
#include <fstream>
#include <regex>
#include <sstream>

#include "berth/robot/package_path.hpp"

namespace berth_ros {
namespace {

/// Packages that the URDF names and the ament index knows.
void add_packages(const std::string& urdf, berth::RobotSettings& settings) {
  static const std::regex kPackage("package://([^/\"]+)/");
  for (std::sregex_iterator at(urdf.begin(), urdf.end(), kPackage), end; at != end; ++at) {
    const std::string name = (*at)[1];
    if (settings.package_paths.count(name) > 0) continue;
    try {
      settings.package_paths[name] = ament_index_cpp::get_package_share_directory(name);
    } catch (const ament_index_cpp::PackageNotFoundError&) {
      // load_robot looks beside the URDF, and names what it lacks.
    }
  }
}

}  // namespace

berth::RobotModel load_description(const std::string& urdf, berth::RobotSettings settings) {
  add_packages(urdf, settings);
  settings.urdf_text = urdf;
  return berth::load_robot(settings);
}

berth::RobotModel load_urdf_file(berth::RobotSettings settings) {
  std::ostringstream text;
  text << std::ifstream(settings.urdf).rdbuf();
  add_packages(text.str(), settings);
  return berth::load_robot(settings);
}

std::filesystem::path mesh_file_of(const std::string& resource) {
  berth::RobotSettings settings;
  add_packages(resource, settings);
  return berth::resolve_mesh_path(resource, "an attached mesh", settings.package_paths);
}

}  // namespace berth_ros
