#include "berth/io/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/io/scene_camera.hpp"
#include "berth/io/yaml_value.hpp"

namespace berth {
namespace {

/// The one of `all` whose name the value is.
template <typename T, std::size_t n>
T one_of(const YamlValue& value, const std::array<T, n>& all) {
  std::vector<std::string_view> names;
  for (const T one : all) names.push_back(name_of(one));
  const std::string name = value.one_of(names);
  return *std::find_if(all.begin(), all.end(), [&](T one) { return name_of(one) == name; });
}

RobotSettings read_robot(const YamlValue& value) {
  const YamlMap map(value,
                    {"urdf", "package_paths", "geometry", "environment_links", "ignore_links"});
  RobotSettings robot;
  robot.urdf = map.at("urdf").path();
  if (const auto packages = map.find("package_paths")) {
    for (const auto& [name, folder] : packages->entries())
      robot.package_paths[name] = folder.path();
  }
  if (const auto geometry = map.find("geometry")) {
    const bool visual = geometry->one_of({"visual", "collision"}) == "visual";
    robot.geometry = visual ? GeometryKind::visual : GeometryKind::collision;
  }
  map.read("environment_links", &YamlValue::texts, robot.environment_links);
  map.read("ignore_links", &YamlValue::texts, robot.ignore_links);
  return robot;
}

std::vector<SceneCamera> read_cameras(const YamlValue& value) {
  std::vector<SceneCamera> cameras;
  for (const YamlValue& item : value.list()) {
    SceneCamera camera = read_scene_camera(item);
    const auto same = [&](const SceneCamera& earlier) { return earlier.name == camera.name; };
    if (std::any_of(cameras.begin(), cameras.end(), same)) {
      item.fail(fmt::format("a second camera is named {}", camera.name), "names that differ");
    }
    cameras.push_back(std::move(camera));
  }
  if (cameras.empty()) value.fail("one camera at least");
  return cameras;
}

void read_self_filter(const YamlValue& value, RigSettings& settings) {
  const YamlMap map(value, {"tolerance_m", "tolerance_per_m", "tolerance_per_m2", "padding_m",
                            "link_padding_m", "padding_depth_m", "dilation_px", "edge_jump_m",
                            "island_radius_m", "island_jump_m", "robot_region_scale"});
  SelfFilterSettings& filter = settings.self_filter;
  map.read("tolerance_m", &YamlValue::non_negative, filter.tolerance_m);
  map.read("tolerance_per_m", &YamlValue::non_negative, filter.tolerance_per_m);
  map.read("tolerance_per_m2", &YamlValue::non_negative, filter.tolerance_per_m2);
  map.read("padding_m", &YamlValue::non_negative, filter.padding_m);
  if (const auto paddings = map.find("link_padding_m")) {
    for (const auto& [link, padding] : paddings->entries()) {
      settings.link_padding_m[link] = padding.non_negative();
    }
  }
  map.read("dilation_px", &YamlValue::count, filter.dilation_px);
  map.read("padding_depth_m", &YamlValue::non_negative, filter.padding_depth_m);
  map.read("edge_jump_m", &YamlValue::non_negative, filter.edge_jump_m);
  map.read("island_radius_m", &YamlValue::non_negative, filter.island_radius_m);
  map.read("island_jump_m", &YamlValue::non_negative, filter.island_jump_m);
  map.read("robot_region_scale", &YamlValue::non_negative, filter.robot_region_scale);
}

void read_sensor(const YamlValue& value, SensorSettings& sensor) {
  const YamlMap map(value, {"noise_m", "speckle_px", "speckle_jump_m", "average_frames",
                            "background_frames", "background_clearance_m", "holes"});
  map.read("noise_m", &YamlValue::non_negative, sensor.noise_m);
  map.read("speckle_px", &YamlValue::count, sensor.speckle_px);
  map.read("speckle_jump_m", &YamlValue::non_negative, sensor.speckle_jump_m);
  map.read("average_frames", &YamlValue::count, sensor.average_frames);
  map.read("background_frames", &YamlValue::count, sensor.background_frames);
  map.read("background_clearance_m", &YamlValue::non_negative, sensor.background_clearance_m);
  if (const auto holes = map.find("holes")) sensor.holes = one_of(*holes, kHolePolicies);
}

void read_evaluation(const YamlValue& value, RigSettings& settings) {
  const YamlMap map(value, {"method", "range_m", "mean_direction", "visibility"});
  if (const auto method = map.find("method")) settings.method = one_of(*method, kMethods);
  map.read("range_m", &YamlValue::positive, settings.distance.range_m);
  map.read("mean_direction", &YamlValue::boolean, settings.distance.mean_direction);
  map.read("visibility", &YamlValue::boolean, settings.visibility);
}

void read_time(const YamlValue& value, JointTimeLimits& limits) {
  const YamlMap map(value, {"max_skew_s", "max_extrapolation_s"});
  map.read("max_skew_s", &YamlValue::non_negative, limits.max_skew_s);
  map.read("max_extrapolation_s", &YamlValue::non_negative, limits.max_extrapolation_s);
}

}  // namespace

SceneFile read_scene(const std::filesystem::path& file) {
  const YamlMap map(load_yaml(file),
                    {"robot", "cameras", "joints", "self_filter", "sensor", "evaluation", "time"});
  SceneFile scene;
  scene.file = file;
  scene.robot = read_robot(map.at("robot"));
  scene.cameras = read_cameras(map.at("cameras"));
  scene.joints = map.at("joints").path();
  RigSettings& settings = scene.settings;
  settings.time.joints = kOnlyBetweenSamples;
  if (const auto filter = map.find("self_filter")) read_self_filter(*filter, settings);
  if (const auto sensor = map.find("sensor")) read_sensor(*sensor, settings.sensor);
  if (const auto evaluation = map.find("evaluation")) read_evaluation(*evaluation, settings);
  if (const auto time = map.find("time")) read_time(*time, settings.time.joints);
  return scene;
}

}  // namespace berth
