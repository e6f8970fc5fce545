#include "berth/scene/scene_camera.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "berth/files/glob.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "berth/types/pose.hpp"

namespace berth {
namespace {

constexpr double kUnitLengthTolerance = 1e-3;
constexpr double kFarthest_m = 1e5;
constexpr double kLargestDepthOffset_m = 1;

std::string read_name(const YamlValue& value) {
  const std::string name = value.text();
  // The results of several cameras stand in folders of their names.
  if (name == "." || name == ".." || name.find('/') != std::string::npos) {
    value.fail("a name that can be a folder's");
  }
  return name;
}

Eigen::Quaterniond read_quaternion(const YamlValue& value) {
  const std::vector<double> q = value.numbers(4);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  if (!(std::abs(rotation.norm() - 1) <= kUnitLengthTolerance)) {
    value.fail(fmt::format("[{}] has length {:.6g}", fmt::join(q, ", "), rotation.norm()),
               "a quaternion x, y, z, w of length 1");
  }
  return rotation.normalized();
}

Eigen::Vector3d read_rpy(const YamlValue& value) {
  const std::vector<double> rpy_rad = value.numbers(3);
  return {rpy_rad[0], rpy_rad[1], rpy_rad[2]};
}

std::vector<std::filesystem::path> read_depth_files(const YamlValue& value) {
  std::vector<std::filesystem::path> files;
  if (value.is_list()) {
    for (const YamlValue& item : value.list()) files.push_back(item.path());
    if (files.empty()) value.fail("one image at least");
    return files;
  }
  if (!is_quick_pattern(value.text())) {
    value.fail("a pattern with wildcards in two parts of the path at most, and eight stars");
  }
  files = glob_files(value.place().file.parent_path(), value.text());
  if (files.empty()) value.fail("a pattern that some file matches, or a list of files");
  return files;
}

std::vector<double> read_stamps(const YamlValue& value, std::size_t image_count) {
  const std::vector<double> stamps_s = value.numbers();
  if (stamps_s.size() != image_count) {
    value.fail(fmt::format("{} stamps", stamps_s.size()),
               fmt::format("one for each of the {} images", image_count));
  }
  for (std::size_t i = 0; i < stamps_s.size(); ++i) {
    if (stamps_s[i] > kLastTime_s) value.list()[i].fail(time_expected(stamps_s[i]));
  }
  for (std::size_t i = 1; i < stamps_s.size(); ++i) {
    if (stamps_s[i] <= stamps_s[i - 1]) {
      value.list()[i].fail(fmt::format("more than {}, the stamp before", stamps_s[i - 1]));
    }
  }
  return stamps_s;
}

}  // namespace

Pose read_pose(const YamlMap& pose) {
  const std::vector<double> xyz_m = pose.at("xyz").numbers(3);
  for (std::size_t i = 0; i < xyz_m.size(); ++i) {
    if (std::abs(xyz_m[i]) > kFarthest_m) pose.at("xyz").list()[i].fail("metres, 100 km at most");
  }
  const auto quaternion = pose.find("quaternion_xyzw");
  const auto rpy = pose.find("rpy");
  if (quaternion.has_value() == rpy.has_value()) {
    throw_bad_file(pose.place(), quaternion ? "has both rotations" : "has no rotation",
                   "either quaternion_xyzw or rpy");
  }
  return Eigen::Translation3d(xyz_m[0], xyz_m[1], xyz_m[2]) *
         (quaternion ? read_quaternion(*quaternion) : rotation_of_rpy(read_rpy(*rpy)));
}

SceneCamera read_scene_camera(const YamlValue& value, const CameraSettings& settings) {
  const YamlMap map(value, {"name", "info", "pose", "depth", "depth_scale", "depth_offset_m",
                            "depth_is", "rectified", "stamps", "near_m", "far_m", "clock_offset_s",
                            "background", "self_filter", "sensor", "space", "watch"});
  const YamlMap pose(map.at("pose"), {"parent", "xyz", "quaternion_xyzw", "rpy"});
  SceneCamera camera;
  camera.name = read_name(map.at("name"));
  camera.info = map.at("info").path();
  camera.parent_link = pose.at("parent").text();
  camera.X_PC = read_pose(pose);
  if (const auto rpy = pose.find("rpy")) camera.rpy_rad = read_rpy(*rpy);
  camera.depth = read_depth_files(map.at("depth"));
  if (const auto stamps = map.find("stamps")) {
    camera.stamps_s = read_stamps(*stamps, camera.depth.size());
  }
  map.read("clock_offset_s", &YamlValue::number, camera.clock_offset_s);
  if (const auto scale = map.find("depth_scale")) {
    camera.depth_scale_m = scale->positive();
    if (!is_depth_scale(camera.depth_scale_m)) scale->fail(kDepthScaleExpected);
  }
  if (const auto offset = map.find("depth_offset_m")) {
    camera.depth_offset_m = offset->number();
    if (std::abs(camera.depth_offset_m) > kLargestDepthOffset_m) offset->fail("metres, -1 to 1");
  }
  if (const auto is = map.find("depth_is")) {
    const bool is_ray = is->one_of({"axis", "ray"}) == "ray";
    camera.depth_is = is_ray ? DepthIs::along_ray : DepthIs::along_axis;
  }
  if (const auto is = map.find("rectified")) camera.is_rectified = is->boolean();
  map.read("near_m", &YamlValue::non_negative, camera.near_m);
  if (const auto far = map.find("far_m")) {
    camera.far_m = far->positive();
    if (camera.far_m <= camera.near_m)
      far->fail(fmt::format("more than near_m, {}", camera.near_m));
  }
  camera.settings = settings;
  read_view_settings(map, camera.settings);
  if (const auto background = map.find("background")) {
    camera.background = background->path();
    if (!camera.settings.sensor.has_background()) {
      background->fail("sensor.background_frames of 1 or more with it, which turns the rule on");
    }
  }
  return camera;
}

}  // namespace berth
