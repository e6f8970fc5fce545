#include "apps/view/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/scene/attach_parts.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

bool is_of_requests(const std::string& group) {
  return group == "evaluation" || group == "time" || group == "separation";
}

YamlPath place_in_camera(std::size_t camera, const std::string& group, const std::string& key) {
  return {"cameras", std::to_string(camera), group, key};
}

void set_value(YamlScalars& values, const YamlPath& place, const std::optional<std::string>& text) {
  if (text) {
    values[place] = *text;
  } else {
    values.erase(place);
  }
}

void require_file_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;
  constexpr std::string_view kEnd = ".yaml";
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  if (name.size() > kEnd.size() && name.size() <= kLongest && name.ends_with(kEnd) &&
      name.front() != '.' && std::all_of(name.begin(), name.end(), is_plain)) {
    return;
  }
  throw std::runtime_error(fmt::format(
      "\"{}\" is no name for a scene; expected letters, digits, -, _ and ., ending in .yaml",
      name));
}

void require_nothing_at(const fs::path& file) {
  if (fs::symlink_status(file).type() == fs::file_type::not_found) return;
  throw std::runtime_error(fmt::format("{}: is there already; expected a new name", file.string()));
}

}  // namespace

ChangedScene::ChangedScene(const fs::path& file)
    : file_(file), text_(read_file_bytes(file)), original_(parse_scene(file, text_)) {
  scalars_ = yaml_scalars(text_);
  now_ = original_;
}

void ChangedScene::set(const std::string& group, const std::string& key,
                       std::optional<std::size_t> camera, const std::optional<std::string>& text) {
  SceneChange change = change_;
  if (camera && !is_of_requests(group)) {
    set_value(change.values, place_in_camera(*camera, group, key), text);
  } else {
    set_value(change.values, {group, key}, text);
    // What a camera's own entry says goes over what the scene says.
    for (std::size_t c = 0; c < original_.cameras.size() && !is_of_requests(group); ++c) {
      const YamlPath own = place_in_camera(c, group, key);
      change.values.erase(own);
      if (text && scalars_.contains(own)) change.values[own] = *text;
    }
  }
  take(std::move(change));
}

void ChangedScene::set_pose(std::size_t camera, const std::optional<Pose>& X_PC) {
  SceneChange change = change_;
  camera_change(change, camera).X_PC = X_PC;
  take(std::move(change));
}

std::vector<Attachment> ChangedScene::carried() const {
  std::vector<Attachment> attached;
  for (const AttachedPart& part : carried_.parts) attached.push_back(attachment_of(part));
  return attached;
}

void ChangedScene::add(const SceneChange& more, const AttachedParts& parts) {
  SceneChange change = change_;
  for (const SceneCameraChange& from : more.cameras) {
    const auto named = [&](const SceneCamera& one) { return one.name == from.camera; };
    const auto at = std::find_if(original_.cameras.begin(), original_.cameras.end(), named);
    const auto number = static_cast<std::size_t>(at - original_.cameras.begin());
    SceneCameraChange& to = camera_change(change, number);
    if (from.X_PC) to.X_PC = from.X_PC;
    if (from.clock_offset_s) to.clock_offset_s = from.clock_offset_s;
    for (const auto& [group, values] : from.maps) {
      for (const auto& [key, value] : values) {
        change.values[place_in_camera(number, group, key)] = fmt::format("{}", value);
      }
    }
  }
  for (const auto& [joint, offset] : more.joint_offsets) change.joint_offsets[joint] = offset;
  take(std::move(change));
  std::ranges::copy_if(parts.parts, std::back_inserter(carried_.parts), &AttachedPart::is_taken);
}

void ChangedScene::reset() {
  take({});
  carried_ = {};
}

fs::path ChangedScene::save(const fs::path& folder, const std::string& name) const {
  require_file_name(name);
  const fs::path file = folder / name;
  require_nothing_at(file);
  for (const AttachedPart& part : carried_.parts) require_nothing_at(attached_file(file, part));
  require_same_file();
  SceneChange change = change_;
  attach_parts(file_, carried_, file, change);
  write_attached_parts(carried_, file);
  write_rewritten_scene(file_, change, file);
  return file;
}

SceneCameraChange& ChangedScene::camera_change(SceneChange& change, std::size_t camera) const {
  const std::string& name = original_.cameras.at(camera).name;
  const auto named = [&](const SceneCameraChange& one) { return one.camera == name; };
  const auto at = std::find_if(change.cameras.begin(), change.cameras.end(), named);
  if (at != change.cameras.end()) return *at;
  change.cameras.emplace_back().camera = name;
  return change.cameras.back();
}

void ChangedScene::require_same_file() const {
  if (read_file_bytes(file_) == text_) return;
  throw std::runtime_error(fmt::format(
      "{}: has changed since it was opened; expected the same text: start berth view again",
      file_.string()));
}

void ChangedScene::take(SceneChange change) {
  require_same_file();
  try {
    now_ = parse_scene(file_, rewritten_scene(file_, change, file_));
  } catch (const BadFile& error) {
    // The file that the user has is as it was: it has no bad line.
    if (error.place().file != file_) throw;
    throw std::runtime_error(error.without_line());
  }
  change_ = std::move(change);
}

}  // namespace berth::app
