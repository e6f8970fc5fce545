#include "berth/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "berth/files/file_bytes.hpp"
#include "berth/files/yaml_value.hpp"
#include "berth/pipeline/request.hpp"
#include "berth/scene/former_settings.hpp"
#include "berth/scene/scene_camera.hpp"
#include "berth/separation/protective_distance.hpp"
#include "berth/types/setting.hpp"

namespace berth {
namespace {

SettingValue read_number(const YamlValue& value, const SettingRef& setting) {
  const Domain& domain = setting.domain;
  if (setting.kind == SettingKind::whole) {
    const int count = value.count();
    if (!domain.holds(count)) value.fail(setting.expected());
    return count;
  }
  const double number = domain.is_open     ? value.positive()
                        : domain.least < 0 ? value.number()
                                           : value.non_negative();
  if (!domain.holds(number)) value.fail(setting.expected());
  return number;
}

SettingValue read_value(const YamlValue& value, const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return value.boolean();
  if (setting.kind == SettingKind::choice) return setting.choice(value.one_of(setting.choices));
  return read_number(value, setting);
}

/// Sets what the map gives. It has no other keys but `others` and the ended_settings() of its
/// group. Throws as YamlValue does.
YamlMap read_settings(const YamlValue& value, std::string_view group,
                      const std::vector<SettingRef>& settings,
                      const std::vector<std::string_view>& others = {}) {
  std::vector<std::string_view> known = others;
  for (const SettingRef& setting : settings) known.push_back(setting.name);
  const YamlMap map(value, known, ended_settings(group));
  for (const SettingRef& setting : settings) {
    if (const auto given = map.find(setting.name)) setting.set(read_value(*given, setting));
  }
  return map;
}

std::map<std::string, std::filesystem::path> read_package_paths(const YamlMap& map) {
  std::map<std::string, std::filesystem::path> paths;
  if (const auto packages = map.find("package_paths")) {
    for (const auto& [name, folder] : packages->entries()) paths[name] = folder.path();
  }
  return paths;
}

OtherRobot read_other_robot(const YamlValue& value) {
  const YamlMap map(value, {"urdf", "package_paths", "prefix", "pose"});
  OtherRobot other;
  other.urdf = map.at("urdf").path();
  other.package_paths = read_package_paths(map);
  map.read("prefix", &YamlValue::text, other.prefix);
  const YamlMap pose(map.at("pose"), {"parent", "xyz", "quaternion_xyzw", "rpy"});
  other.parent = pose.at("parent").text();
  other.X_PR = read_pose(pose);
  return other;
}

RobotSettings read_robot(const YamlValue& value) {
  const YamlMap map(value, {"urdf", "package_paths", "geometry", "environment_links",
                            "ignore_links", "guarded_links", "srdf", "allowed_contacts", "others"});
  RobotSettings robot;
  robot.urdf = map.at("urdf").path();
  robot.package_paths = read_package_paths(map);
  if (const auto geometry = map.find("geometry")) {
    const bool visual = geometry->one_of({"visual", "collision"}) == "visual";
    robot.geometry = visual ? GeometryKind::visual : GeometryKind::collision;
  }
  map.read("environment_links", &YamlValue::texts, robot.environment_links);
  map.read("ignore_links", &YamlValue::texts, robot.ignore_links);
  map.read("guarded_links", &YamlValue::texts, robot.guarded_links);
  map.read("srdf", &YamlValue::path, robot.srdf);
  if (const auto contacts = map.find("allowed_contacts")) {
    for (const YamlValue& pair : contacts->list()) {
      const std::vector<std::string> links = pair.texts();
      if (links.size() != 2) pair.fail(fmt::format("{} links", links.size()), "two links");
      robot.allowed_contacts.push_back({links[0], links[1]});
    }
  }
  if (const auto others = map.find("others")) {
    for (const YamlValue& other : others->list()) robot.others.push_back(read_other_robot(other));
  }
  return robot;
}

std::vector<SceneCamera> read_cameras(const YamlValue& value, const CameraSettings& settings) {
  std::vector<SceneCamera> cameras;
  for (const YamlValue& item : value.list()) {
    SceneCamera camera = read_scene_camera(item, settings);
    const auto same = [&](const SceneCamera& earlier) { return earlier.name == camera.name; };
    if (std::any_of(cameras.begin(), cameras.end(), same)) {
      item.fail(fmt::format("a second camera is named {}", camera.name), "names that differ");
    }
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty() || cameras.size() > kMostCameras) {
    value.fail(fmt::format("{} cameras", cameras.size()),
               fmt::format("1 to {} cameras", kMostCameras));
  }
  return cameras;
}

SceneAttachment read_attachment(const YamlValue& value) {
  const YamlMap map(value, {"link", "name", "mesh", "box", "cylinder", "sphere", "pose", "sharp",
                            "soft", "may_touch"});
  SceneAttachment attachment;
  attachment.link = map.at("link").text();
  map.read("name", &YamlValue::text, attachment.name);
  int shapes = 0;
  if (const auto mesh = map.find("mesh")) {
    attachment.mesh = mesh->path();
    ++shapes;
  }
  const auto lengths = [&](std::string_view key, std::size_t count) {
    const auto found = map.find(key);
    if (!found) return std::vector<double>();
    ++shapes;
    const std::vector<double> lengths_m = found->numbers(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (lengths_m[i] <= 0) found->list()[i].fail("a length above 0, in metres");
    }
    return lengths_m;
  };
  if (const auto box = lengths("box", 3); !box.empty()) {
    attachment.box_m = Eigen::Vector3d(box[0], box[1], box[2]);
  }
  if (const auto cylinder = lengths("cylinder", 2); !cylinder.empty()) {
    attachment.cylinder_m = Eigen::Vector2d(cylinder[0], cylinder[1]);
  }
  if (const auto sphere = map.find("sphere")) {
    attachment.sphere_radius_m = sphere->positive();
    ++shapes;
  }
  if (shapes != 1) {
    throw_bad_file(map.place(), shapes == 0 ? "has no shape" : "has several shapes",
                   "one of mesh, box, cylinder and sphere");
  }
  if (const auto pose = map.find("pose")) {
    attachment.X_LA = read_pose(YamlMap(*pose, {"xyz", "quaternion_xyzw", "rpy"}));
  }
  map.read("sharp", &YamlValue::boolean, attachment.is_sharp);
  map.read("soft", &YamlValue::boolean, attachment.is_soft);
  map.read("may_touch", &YamlValue::texts, attachment.may_touch);
  attachment.place = fmt::format("{}:{}", map.place().file.string(), map.place().line);
  return attachment;
}

std::vector<SceneAttachment> read_attached(const YamlValue& value) {
  std::vector<SceneAttachment> attached;
  for (const YamlValue& item : value.list()) attached.push_back(read_attachment(item));
  return attached;
}

/// Numbers by the name of a joint.
std::map<std::string, double> read_joint_values(const YamlMap& map, std::string_view key) {
  std::map<std::string, double> values;
  if (const auto joints = map.find(key)) {
    for (const auto& [joint, value] : joints->entries()) values[joint] = value.number();
  }
  return values;
}

SeparationSettings read_separation(const YamlValue& value) {
  SeparationSettings settings;
  const YamlMap keys = read_settings(value, "separation", setting_refs(settings), {"stopping"});
  if (const auto stopping = keys.find("stopping")) {
    for (const YamlValue& item : stopping->list()) {
      const YamlMap row(item, {"speed_m_s", "time_s", "distance_m"});
      settings.stopping.push_back({row.at("speed_m_s").positive(), row.at("time_s").non_negative(),
                                   row.at("distance_m").non_negative()});
    }
  }
  return settings;
}

/// Where C stands on nothing.
void warn_of_what_is_not_shown(SceneFile& scene, int line) {
  if (scene.separation->intrusion_m || scene.separation->detection_m) return;
  scene.warnings.push_back(
      fmt::format("{}:{}: separation: nobody has shown how small a thing the cameras detect; C is "
                  "{} m. Set detection_m or intrusion_m",
                  scene.file.string(), line, kUnprovenIntrusion_m));
}

}  // namespace

void read_view_settings(const YamlMap& map, CameraSettings& settings) {
  if (const auto filter = map.find("self_filter")) {
    const YamlMap keys = read_settings(*filter, "self_filter", setting_refs(settings.self_filter),
                                       {"link_padding_m"});
    if (const auto paddings = keys.find("link_padding_m")) {
      for (const auto& [link, padding] : paddings->entries()) {
        settings.link_padding_m[link] = padding.non_negative();
      }
    }
  }
  if (const auto sensor = map.find("sensor")) {
    require_no_hole_policy(read_settings(*sensor, "sensor", setting_refs(settings.sensor)));
  }
  if (const auto space = map.find("space")) {
    read_settings(*space, "space", setting_refs(settings.space));
  }
  if (const auto watch = map.find("watch")) {
    read_settings(*watch, "watch", setting_refs(settings.watch));
  }
}

SceneFile read_scene(const std::filesystem::path& file) {
  return parse_scene(file, read_file_bytes(file));
}

SceneFile parse_scene(const std::filesystem::path& file, const std::string& text) {
  const YamlValue document = parse_yaml(file, text);
  const YamlMap map(
      document, {"robot", "cameras", "attached", "joints", "joint_offsets", "fixed_joints",
                 "self_filter", "sensor", "space", "watch", "evaluation", "time", "separation"});
  SceneFile scene;
  scene.file = file;
  scene.warnings = ended_settings_in(document);
  scene.robot = read_robot(map.at("robot"));
  CameraSettings settings = settings_of_real_camera();
  read_view_settings(map, settings);
  scene.cameras = read_cameras(map.at("cameras"), settings);
  if (const auto attached = map.find("attached")) scene.attached = read_attached(*attached);
  scene.joints = map.at("joints").path();
  scene.joint_offsets = read_joint_values(map, "joint_offsets");
  scene.fixed_joints = read_joint_values(map, "fixed_joints");
  scene.evaluation.time.joints = kInRecordings;
  if (const auto evaluation = map.find("evaluation")) {
    read_settings(*evaluation, "evaluation", setting_refs(scene.evaluation));
  }
  if (const auto time = map.find("time")) {
    read_settings(*time, "time", setting_refs(scene.evaluation.time));
  }
  if (const auto separation = map.find("separation")) {
    scene.separation = read_separation(*separation);
    warn_of_what_is_not_shown(scene, separation->place().line);
  }
  return scene;
}

}  // namespace berth
