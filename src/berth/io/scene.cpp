#include "berth/io/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/io/scene_camera.hpp"
#include "berth/io/yaml_value.hpp"

namespace berth {
namespace {

SceneRobot read_robot(const YamlValue& value) {
  const YamlMap map(value,
                    {"urdf", "package_paths", "geometry", "environment_links", "ignore_links"});
  SceneRobot robot;
  robot.urdf = map.at("urdf").path();
  if (const auto packages = map.find("package_paths")) {
    for (const auto& [name, folder] : packages->entries())
      robot.package_paths[name] = folder.path();
  }
  if (const auto geometry = map.find("geometry")) {
    const bool visual = geometry->one_of({"visual", "collision"}) == "visual";
    robot.geometry = visual ? SceneRobot::Geometry::visual : SceneRobot::Geometry::collision;
  }
  using Names = std::vector<std::string>;
  robot.environment_links = map.get("environment_links", &YamlValue::texts).value_or(Names());
  robot.ignore_links = map.get("ignore_links", &YamlValue::texts).value_or(Names());
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

SceneSelfFilter read_self_filter(const YamlValue& value) {
  const YamlMap map(value, {"tolerance_m", "tolerance_per_m", "tolerance_per_m2", "padding_m",
                            "link_padding_m", "dilation_px", "edge_jump_m", "island_radius_m",
                            "island_jump_m", "robot_region_scale"});
  SceneSelfFilter filter;
  filter.tolerance_m = map.get("tolerance_m", &YamlValue::non_negative);
  filter.tolerance_per_m = map.get("tolerance_per_m", &YamlValue::non_negative);
  filter.tolerance_per_m2 = map.get("tolerance_per_m2", &YamlValue::non_negative);
  filter.padding_m = map.get("padding_m", &YamlValue::non_negative);
  if (const auto paddings = map.find("link_padding_m")) {
    for (const auto& [link, padding] : paddings->entries()) {
      filter.link_padding_m[link] = padding.non_negative();
    }
  }
  filter.dilation_px = map.get("dilation_px", &YamlValue::count);
  filter.edge_jump_m = map.get("edge_jump_m", &YamlValue::non_negative);
  filter.island_radius_m = map.get("island_radius_m", &YamlValue::non_negative);
  filter.island_jump_m = map.get("island_jump_m", &YamlValue::non_negative);
  filter.robot_region_scale = map.get("robot_region_scale", &YamlValue::non_negative);
  return filter;
}

SceneSensor read_sensor(const YamlValue& value) {
  const YamlMap map(value, {"noise_m", "speckle_px", "speckle_jump_m", "average_frames",
                            "background_frames", "background_clearance_m", "holes"});
  SceneSensor sensor;
  sensor.noise_m = map.get("noise_m", &YamlValue::non_negative);
  sensor.speckle_px = map.get("speckle_px", &YamlValue::count);
  sensor.speckle_jump_m = map.get("speckle_jump_m", &YamlValue::non_negative);
  sensor.average_frames = map.get("average_frames", &YamlValue::count);
  sensor.background_frames = map.get("background_frames", &YamlValue::count);
  sensor.background_clearance_m = map.get("background_clearance_m", &YamlValue::non_negative);
  if (const auto holes = map.find("holes")) {
    sensor.holes = holes->one_of({"free", "obstacle", "nearest_neighbour"});
  }
  return sensor;
}

SceneEvaluation read_evaluation(const YamlValue& value) {
  const YamlMap map(value, {"method", "range_m", "mean_direction", "visibility"});
  SceneEvaluation evaluation;
  if (const auto method = map.find("method")) {
    evaluation.method =
        method->one_of({"exact", "brute_force", "lattice", "gl_lattice", "gl_hybrid", "gl_exact"});
  }
  evaluation.range_m = map.get("range_m", &YamlValue::positive);
  evaluation.mean_direction = map.get("mean_direction", &YamlValue::boolean);
  evaluation.visibility = map.get("visibility", &YamlValue::boolean);
  return evaluation;
}

SceneTime read_time(const YamlValue& value) {
  const YamlMap map(value, {"max_skew_s", "max_extrapolation_s"});
  return {map.get("max_skew_s", &YamlValue::non_negative),
          map.get("max_extrapolation_s", &YamlValue::non_negative)};
}

}  // namespace

SceneFile read_scene(const std::filesystem::path& file) {
  const YamlMap map(load_yaml(file), {"robot", "cameras", "joints", "self_filter", "sensor",
                                      "evaluation", "time"});
  SceneFile scene;
  scene.file = file;
  scene.robot = read_robot(map.at("robot"));
  scene.cameras = read_cameras(map.at("cameras"));
  scene.joints = map.at("joints").path();
  if (const auto filter = map.find("self_filter")) scene.self_filter = read_self_filter(*filter);
  if (const auto sensor = map.find("sensor")) scene.sensor = read_sensor(*sensor);
  if (const auto evaluation = map.find("evaluation")) {
    scene.evaluation = read_evaluation(*evaluation);
  }
  if (const auto time = map.find("time")) scene.time = read_time(*time);
  return scene;
}

}  // namespace berth
