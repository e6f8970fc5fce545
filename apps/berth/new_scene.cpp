#include "apps/berth/new_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// What suits a kind of camera; the same as in the examples of docs/scene.md and in
/// docs/sensors.md.
struct CameraKind {
  std::string_view name;
  std::string_view what;
  /// Keys of the camera, a line each.
  std::vector<std::string_view> lines;
};

const std::array<CameraKind, 5>& camera_kinds() {
  static const std::array<CameraKind, 5> kinds = {{
      {"other", "any camera: try without rules first, and look at the pictures", {}},
      {"realsense",
       "RealSense, active stereo: it smears depth beside the arm",
       {"near_m: 0.28", "far_m: 4.0", "sensor: {speckle_px: 20}"}},
      {"zed",
       "ZED, passive stereo: no readings where there is no texture",
       {"near_m: 0.3", "far_m: 5.0", "sensor: {speckle_px: 20}"}},
      {"kinect",
       "Azure Kinect, time of flight",
       {"near_m: 0.25", "far_m: 5.5", "sensor: {speckle_px: 10}"}},
      {"orbbec",
       "Orbbec Femto, time of flight; a Gemini is active stereo, like a RealSense",
       {"near_m: 0.25", "far_m: 5.5", "sensor: {speckle_px: 10}"}},
  }};
  return kinds;
}

/// A word that YAML reads as itself.
std::string yaml_word(std::string_view text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '/';
  };
  if (!text.empty() && std::isalpha(static_cast<unsigned char>(text.front())) &&
      std::ranges::all_of(text, is_plain)) {
    return std::string(text);
  }
  if (text.starts_with("../") && std::ranges::all_of(text, is_plain)) return std::string(text);
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

std::string yaml_path(const fs::path& path, const fs::path& out) {
  return yaml_word(fs::proximate(path, fs::absolute(out).parent_path()).string());
}

std::string yaml_list(const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) words.push_back(yaml_word(name));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

std::string robot_text(const NewScene& scene, const RobotModel& model) {
  std::string text = fmt::format("robot:\n  urdf: {}\n", yaml_path(scene.robot.urdf, scene.out));
  if (!scene.robot.package_paths.empty()) {
    text += "  package_paths:\n";
    for (const auto& [name, folder] : scene.robot.package_paths) {
      text += fmt::format("    {}: {}\n", yaml_word(name), yaml_path(folder, scene.out));
    }
  }
  const std::vector<std::string> environment = likely_environment(model);
  text +=
      "  # What stands around the robot and is in the URDF: removed from the images, not asked.\n";
  text += environment.empty() ? "  # environment_links: [table]\n"
                              : fmt::format("  environment_links: {}\n", yaml_list(environment));
  std::vector<std::string> links = model.evaluated_link_names();
  std::erase_if(links, [&](const std::string& link) {
    return std::ranges::find(environment, link) != environment.end();
  });
  return text + fmt::format("  # Links that get a distance: {}\n", fmt::join(links, ", "));
}

std::string camera_text(const CameraKind& kind, const RobotModel& model) {
  std::string text = fmt::format(
      "cameras:                                     # one to eight\n"
      "  - name: camera\n"
      "    # Of the depth image, rectified: a ROS camera_info file, or what is printed by\n"
      "    #   ros2 topic echo --once CAMERA_INFO_TOPIC\n"
      "    info: camera_info.yaml\n"
      "    # FILL IN: where the camera is, to within 20 cm and 15 degrees; berth calibrate finds "
      "the rest.\n"
      "    # The optical frame in the link `parent`: z forward, x right, y down. This one looks "
      "from 1.5 m\n"
      "    # before the robot at its foot.\n"
      "    pose: {{parent: {}, xyz: [1.5, 0.0, 1.0], quaternion_xyzw: [-0.5855, -0.5855, 0.3964, "
      "0.3964]}}\n"
      "    depth: depth/*.png                       # 16-bit PNGs, in the order of their names\n"
      "    depth_scale: 0.001                       # metres for each unit\n"
      "    # FILL IN: a time in seconds for each image, of the clock of the joints. Without it "
      "image k belongs\n"
      "    # to row k of the joints.\n"
      "    # stamps: [0.000, 0.033]\n",
      yaml_word(model.links.front().name));
  text += fmt::format("    # {}:\n", kind.what);
  for (const std::string_view line : kind.lines) text += fmt::format("    {}\n", line);
  if (kind.lines.empty()) text += "    # sensor: {speckle_px: 20}\n";
  return text;
}

std::string joints_text(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  return fmt::format(
      "# A CSV file with this first line, then numbers: seconds, rad or m.\n"
      "#   time{}{}\n"
      "joints: joints.csv\n"
      "# Joints that never move and have no column, such as a gripper's:\n"
      "# fixed_joints: {{{}: 0.0}}\n",
      names.empty() ? "" : ",", fmt::join(names, ","),
      names.empty() ? "finger_joint" : yaml_word(names.back()));
}

}  // namespace

std::vector<std::string> camera_kind_names() {
  std::vector<std::string> names;
  for (const CameraKind& kind : camera_kinds()) names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> likely_environment(const RobotModel& model) {
  std::set<std::size_t> bases;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const auto parent = model.links[i].parent;
    if (parent && model.is_moved(i) && !model.is_moved(*parent)) bases.insert(*parent);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const bool has_geometry = model.links[i].role == LinkRole::evaluated;
    if (has_geometry && !model.is_moved(i) && !bases.contains(i))
      names.push_back(model.links[i].name);
  }
  return names;
}

std::string new_scene_text(const NewScene& scene, const RobotModel& model) {
  const auto& kinds = camera_kinds();
  const CameraKind& kind = *std::ranges::find(kinds, scene.camera, &CameraKind::name);
  return fmt::format(
      "# yaml-language-server: $schema={}\n"
      "# Made by berth init for robot \"{}\". Lines with FILL IN are yours to fill in; then:\n"
      "#   berth doctor SCENE                       what is wrong, and what to do next\n"
      "#   berth calibrate SCENE --out NEW.yaml     where the camera is, and settings that fit it\n"
      "#   berth run NEW.yaml --picture pictures\n"
      "{}{}{}"
      "evaluation: {{range_m: 1.0}}                 # how far to look\n"
      "# How fast the robot may go on beside people:\n"
      "# separation: {{}}\n",
      scene.schema.string(), model.name, robot_text(scene, model), camera_text(kind, model),
      joints_text(model));
}

}  // namespace berth::app
