#include "apps/view/settings_message.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "berth/files/setting_json.hpp"
#include "berth/types/pose.hpp"
#include "berth/types/setting.hpp"

namespace berth::app {
namespace {

using Json = nlohmann::ordered_json;

/// The unit that the name ends in.
std::string_view unit_of_setting(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
      {"_m_s2", "m/s²"}, {"_m_s", "m/s"}, {"_per_m2", "1/m"}, {"_per_m", ""},
      {"_m", "m"},       {"_px", "px"},   {"_us", "µs"},      {"_s", "s"}};
  for (const auto& [end, unit] : kUnits) {
    if (name.ends_with(end)) return unit;
  }
  return "";
}

Json kind_json(const SettingRef& setting) {
  if (setting.kind == SettingKind::flag) return {{"kind", "bool"}};
  if (setting.kind == SettingKind::choice) {
    return {{"kind", "choice"}, {"choices", setting.choices}};
  }
  const Domain& domain = setting.domain;
  Json json = {{"kind", setting.kind == SettingKind::whole ? "whole" : "number"},
               {"least", domain.has_off ? 0 : domain.least},
               {"domain", setting.expected()}};
  if (std::isfinite(domain.most)) json["most"] = domain.most;
  return json;
}

/// One object for each setting.
Json described(const std::vector<SettingRef>& settings) {
  Json all = Json::array();
  for (const SettingRef& setting : settings) {
    Json json = {{"name", setting.name},
                 {"unit", unit_of_setting(setting.name)},
                 {"sentence", setting.sentence}};
    json.update(kind_json(setting));
    all.push_back(std::move(json));
  }
  return all;
}

Json values_of(const std::vector<SettingRef>& settings) {
  Json values = Json::array();
  for (const SettingRef& setting : settings) {
    values.push_back(setting_json(setting.value, [](double value) {
      return std::isfinite(value) ? Json(value) : Json("no limit");
    }));
  }
  return values;
}

Json request_group(std::string_view name, const auto& now, const auto& original) {
  return {{"name", name},
          {"by_camera", false},
          {"settings", described(setting_refs(now))},
          {"now", Json::array({values_of(setting_refs(now))})},
          {"file", Json::array({values_of(setting_refs(original))})}};
}

/// The values of one group of a camera's settings.
Json camera_values(const SceneCamera& camera, std::string_view group) {
  Json values;
  visit_setting_groups(camera.settings, [&](std::string_view name, const auto& settings) {
    if (name == group) values = values_of(setting_refs(settings));
  });
  return values;
}

Json camera_groups(const ChangedScene& scene) {
  Json groups = Json::array();
  const CameraSettings& first = scene.now().cameras.front().settings;
  visit_setting_groups(first, [&](std::string_view name, const auto& settings) {
    Json group = {
        {"name", name}, {"by_camera", true}, {"settings", described(setting_refs(settings))}};
    for (std::size_t c = 0; c < scene.now().cameras.size(); ++c) {
      group["now"].push_back(camera_values(scene.now().cameras[c], name));
      group["file"].push_back(camera_values(scene.original().cameras[c], name));
    }
    groups.push_back(std::move(group));
  });
  return groups;
}

Json pose_json(const SceneCamera& camera) {
  const Eigen::Vector3d xyz_m = camera.X_PC.translation();
  const Eigen::Vector3d rpy_rad = rpy_of(camera.X_PC.linear());
  return {{"xyz_m", {xyz_m.x(), xyz_m.y(), xyz_m.z()}},
          {"rpy_rad", {rpy_rad.x(), rpy_rad.y(), rpy_rad.z()}}};
}

Json poses(const ChangedScene& scene) {
  Json all = Json::array();
  for (std::size_t c = 0; c < scene.now().cameras.size(); ++c) {
    all.push_back({{"camera", scene.now().cameras[c].name},
                   {"parent", scene.now().cameras[c].parent_link},
                   {"now", pose_json(scene.now().cameras[c])},
                   {"file", pose_json(scene.original().cameras[c])}});
  }
  return all;
}

}  // namespace

PageMessage settings_message(const ChangedScene& scene) {
  Json groups = camera_groups(scene);
  // Without what only methods that compare images have.
  const EvaluationSettings& now = scene.now().evaluation;
  const EvaluationSettings& original = scene.original().evaluation;
  groups.push_back(request_group("evaluation", now, original));
  groups.push_back(request_group("time", now.time, original.time));
  if (scene.now().separation) {
    groups.push_back(request_group("separation", *scene.now().separation,
                                   scene.original().separation.value_or(SeparationSettings())));
  }
  return json_message({{"type", "settings"}, {"groups", groups}, {"poses", poses(scene)}});
}

}  // namespace berth::app
