#include "berth/scene/rewrite_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/files/glob.hpp"
#include "berth/files/number.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/types/pose.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

constexpr double kMostPoseError = 1e-9;

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

fs::path real_path(const fs::path& path) {
  fs::path result = fs::weakly_canonical(fs::absolute(path).lexically_normal());
  return result.has_filename() ? result : result.parent_path();
}

/// Where a scene names files and folders; "*" is any one step.
const std::array<YamlPath, 11> kPlacesOfPaths = {{{"robot", "urdf"},
                                                  {"robot", "package_paths", "*"},
                                                  {"cameras", "*", "info"},
                                                  {"cameras", "*", "depth"},
                                                  {"cameras", "*", "depth", "*"},
                                                  {"cameras", "*", "background"},
                                                  {"joints"},
                                                  {"attached", "*", "mesh"},
                                                  {"robot", "srdf"},
                                                  {"robot", "others", "*", "urdf"},
                                                  {"robot", "others", "*", "package_paths", "*"}}};
const YamlPath& kPlaceOfPattern = kPlacesOfPaths[3];

bool is_place(const YamlPath& path, const YamlPath& place) {
  const auto fits = [](const std::string& step, const std::string& wanted) {
    return wanted == "*" || step == wanted;
  };
  return std::equal(path.begin(), path.end(), place.begin(), place.end(), fits);
}

void move_paths(const YamlScalars& scene, const fs::path& from_file, const fs::path& to_file,
                YamlScalars& changed) {
  const PathMove move(from_file, to_file);
  for (const auto& [place, text] : scene) {
    const auto names_file = [&path = place](const YamlPath& known) {
      return is_place(path, known);
    };
    if (std::none_of(kPlacesOfPaths.begin(), kPlacesOfPaths.end(), names_file)) continue;
    const std::string moved =
        is_place(place, kPlaceOfPattern) ? move.pattern(text) : move.path(text).string();
    if (moved != text) changed[place] = moved;
  }
}

/// With the line that names the JSON Schema for editors, unless it is a URL, as it holds from the
/// new place.
std::string with_moved_schema(std::string text, const PathMove& move) {
  constexpr std::string_view kLine = "# yaml-language-server: $schema=";
  const std::size_t line = text.find(kLine);
  if (line == std::string::npos) return text;
  const std::size_t first = line + kLine.size();
  const std::size_t length = std::min(text.find_first_of(" \t\r\n", first), text.size()) - first;
  const std::string schema = text.substr(first, length);
  if (schema.find("://") != std::string::npos) return text;
  return text.replace(first, length, move.path(schema).string());
}

/// With ten decimals at most.
std::string printed_number(double value) {
  std::string text = fmt::format("{:.10f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

YamlPath joined(YamlPath path, const YamlPath& more) {
  path.insert(path.end(), more.begin(), more.end());
  return path;
}

/// The new pose with the user's kind of rotation, a quaternion with the user's sign.
void change_pose(const Pose& X_PC, const YamlScalars& scene, const YamlPath& pose,
                 YamlScalars& changed) {
  const auto set_list = [&](const std::string& key, const auto& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      changed[joined(pose, {key, std::to_string(i)})] = printed_number(values[i]);
    }
  };
  set_list("xyz", X_PC.translation());
  if (scene.contains(joined(pose, {"rpy", "0"}))) return set_list("rpy", rpy_of(X_PC.linear()));
  Eigen::Vector4d xyzw = Eigen::Quaterniond(X_PC.linear()).normalized().coeffs();
  Eigen::Vector4d old_xyzw;
  for (Eigen::Index i = 0; i < old_xyzw.size(); ++i) {
    old_xyzw[i] = *parse_finite(scene.at(joined(pose, {"quaternion_xyzw", std::to_string(i)})));
  }
  if (xyzw.dot(old_xyzw) < 0) xyzw = -xyzw;
  set_list("quaternion_xyzw", xyzw);
}

std::string exact(double value) { return fmt::format("{}", value); }

std::size_t index_of(const SceneFile& scene, const std::string& camera) {
  const auto named = [&](const SceneCamera& one) { return one.name == camera; };
  const auto at = std::find_if(scene.cameras.begin(), scene.cameras.end(), named);
  if (at == scene.cameras.end()) {
    throw std::invalid_argument(
        fmt::format("{}: no camera is named {}", scene.file.string(), camera));
  }
  return static_cast<std::size_t>(at - scene.cameras.begin());
}

void change_camera(const SceneCameraChange& change, const YamlScalars& scene,
                   const YamlPath& camera, YamlScalars& changed) {
  const auto set = [&](const std::string& key, const std::optional<double>& value) {
    if (value) changed[joined(camera, {key})] = exact(*value);
  };
  set("clock_offset_s", change.clock_offset_s);
  set("depth_scale", change.depth_scale_m);
  set("depth_offset_m", change.depth_offset_m);
  if (change.background) {
    changed[joined(camera, {"background"})] = change.background->filename().string();
  }
  if (change.X_PC) change_pose(*change.X_PC, scene, joined(camera, {"pose"}), changed);
  for (const auto& [map, values] : change.maps) {
    for (const auto& [key, value] : values) changed[joined(camera, {map, key})] = exact(value);
  }
}

void require_same_file(const SceneFile& scene, const std::string& where, const fs::path& found,
                       const fs::path& expected) {
  if (is_same_path(found, expected)) return;
  throw_bad_file({scene.file, 0, where}, "would lead to " + found.string(), expected.string());
}

/// Throws unless the new scene names the same files as the old one.
void require_same_files(const SceneFile& found, const SceneFile& expected) {
  const auto same = [&](const std::string& where, const fs::path& file, const fs::path& wanted) {
    require_same_file(expected, where, file, wanted);
  };
  same("robot.urdf", found.robot.urdf, expected.robot.urdf);
  for (const auto& [name, folder] : expected.robot.package_paths) {
    same("robot.package_paths." + name, found.robot.package_paths.at(name), folder);
  }
  if (!expected.robot.srdf.empty()) same("robot.srdf", found.robot.srdf, expected.robot.srdf);
  for (std::size_t i = 0; i < expected.robot.others.size(); ++i) {
    const OtherRobot &one = found.robot.others[i], &wanted = expected.robot.others[i];
    const std::string where = fmt::format("robot.others[{}].", i);
    same(where + "urdf", one.urdf, wanted.urdf);
    for (const auto& [name, folder] : wanted.package_paths) {
      same(where + "package_paths." + name, one.package_paths.at(name), folder);
    }
  }
  same("joints", found.joints, expected.joints);
  for (std::size_t i = 0; i < expected.attached.size(); ++i) {
    if (expected.attached[i].mesh.empty()) continue;
    same(fmt::format("attached[{}].mesh", i), found.attached[i].mesh, expected.attached[i].mesh);
  }
  for (std::size_t i = 0; i < expected.cameras.size(); ++i) {
    const std::string where = fmt::format("cameras[{}].", i);
    const SceneCamera& camera = expected.cameras[i];
    same(where + "info", found.cameras[i].info, camera.info);
    if (camera.background)
      same(where + "background", found.cameras[i].background.value(), *camera.background);
    if (found.cameras[i].depth.size() != camera.depth.size()) {
      throw_bad_file({expected.file, 0, where + "depth"},
                     fmt::format("would be {} images", found.cameras[i].depth.size()),
                     fmt::format("{}", camera.depth.size()));
    }
    for (std::size_t k = 0; k < camera.depth.size(); ++k) {
      same(fmt::format("{}depth[{}]", where, k), found.cameras[i].depth[k], camera.depth[k]);
    }
  }
}

SceneFile with_backgrounds(SceneFile scene, const SceneChange& change) {
  for (const SceneCameraChange& camera : change.cameras) {
    if (!camera.background) continue;
    scene.cameras[index_of(scene, camera.camera)].background = fs::absolute(*camera.background);
  }
  return scene;
}

/// With what is carried in the order of the new file.
SceneFile with_attached(SceneFile scene, const SceneChange& change) {
  for (const SceneAttachmentChange& one : change.attached) {
    SceneAttachment attachment;
    attachment.link = one.link;
    attachment.name = one.name;
    attachment.mesh = fs::absolute(one.mesh);
    scene.attached.insert(scene.attached.begin(), attachment);
  }
  return scene;
}

/// Throws unless the new scene has the given poses; cameras without one have theirs of before.
void require_poses(const SceneFile& found, const SceneFile& scene, const SceneChange& change) {
  std::vector<Pose> wanted;
  for (const SceneCamera& camera : scene.cameras) wanted.push_back(camera.X_PC);
  for (const SceneCameraChange& camera : change.cameras) {
    if (camera.X_PC) wanted[index_of(scene, camera.camera)] = *camera.X_PC;
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Pose& X_PC = found.cameras[i].X_PC;
    const double error = (X_PC.matrix() - wanted[i].matrix()).cwiseAbs().maxCoeff();
    if (error <= kMostPoseError) continue;
    throw_bad_file({scene.file, 0, fmt::format("cameras[{}].pose", i)},
                   fmt::format("would be off by {:.3g}", error),
                   "a rigid transform within 100 km, given to 1e-9");
  }
}

}  // namespace

std::string rewritten_scene(const fs::path& scene_file, const SceneChange& change,
                            const fs::path& new_file) {
  const fs::path new_folder = fs::absolute(new_file).parent_path();
  if (!fs::is_directory(new_folder)) {
    throw_bad_file({new_file}, "its folder is missing", "a file in a folder that is there");
  }
  const std::string text = read_file_bytes(scene_file);
  const SceneFile scene = parse_scene(scene_file, text);
  const YamlScalars scalars = yaml_scalars(text);
  YamlScalars changed;
  move_paths(scalars, scene_file, new_file, changed);
  for (const SceneCameraChange& camera : change.cameras) {
    const std::size_t index = index_of(scene, camera.camera);
    change_camera(camera, scalars, {"cameras", std::to_string(index)}, changed);
  }
  for (const auto& [joint, offset] : change.joint_offsets) {
    changed[{"joint_offsets", joint}] = exact(offset);
  }
  for (const auto& [place, value] : change.values) changed[place] = value;
  std::string new_text =
      with_moved_schema(edited_yaml(scene_file, text, changed), PathMove(scene_file, new_file));
  for (const SceneAttachmentChange& one : change.attached) {
    new_text = with_list_item(
        scene_file, new_text, "attached",
        {{"link", one.link}, {"mesh", one.mesh.filename().string()}, {"name", one.name}});
  }
  const SceneFile new_scene = parse_scene(new_file, new_text);
  require_same_files(new_scene, with_attached(with_backgrounds(scene, change), change));
  require_poses(new_scene, scene, change);
  return new_text;
}

void write_rewritten_scene(const fs::path& scene_file, const SceneChange& change,
                           const fs::path& new_file) {
  if (fs::exists(new_file) && fs::equivalent(scene_file, new_file)) {
    throw_bad_file({new_file}, fmt::format("is the same file as {}", scene_file.string()),
                   "another one: the scene itself is never overwritten");
  }
  write_file_bytes(new_file, rewritten_scene(scene_file, change, new_file));
}

bool is_same_path(const fs::path& a, const fs::path& b) { return real_path(a) == real_path(b); }

PathMove::PathMove(const fs::path& from_file, const fs::path& to_file)
    : from_(folder_of(from_file)), to_(folder_of(to_file)), stays_(is_same_path(from_, to_)) {}

fs::path PathMove::path(const fs::path& path) const {
  if (stays_ || path.is_absolute()) return path;
  // The reader of a scene takes ".." away by the text alone, others by the file system: a relative
  // path has to hold for both.
  const fs::path target = (from_ / path).lexically_normal();
  const fs::path relative = target.lexically_relative(to_);
  return is_same_path(real_path(to_) / relative, target) ? relative : target;
}

std::string PathMove::pattern(const std::string& pattern) const {
  if (stays_ || fs::path(pattern).is_absolute()) return pattern;
  return (fs::path(escape_glob(path(".").string())) / pattern).lexically_normal().string();
}

}  // namespace berth
