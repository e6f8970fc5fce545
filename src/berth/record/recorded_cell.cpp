#include "berth/record/recorded_cell.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "berth/files/error.hpp"
#include "berth/files/setting_json.hpp"
#include "berth/record/exact_json.hpp"
#include "berth/record/recorded_robot.hpp"
#include "berth/types/setting.hpp"

namespace berth {
namespace {

Json settings_json(const std::vector<SettingRef>& settings) {
  Json out = Json::object();
  for (const SettingRef& setting : settings) {
    out[setting.name] = setting_json(setting.value, [](double value) { return exact(value); });
  }
  return out;
}

SettingValue value_of(const Json& json, const SettingRef& setting) {
  if (setting.is_optional && json.is_null()) return {};
  if (setting.kind == SettingKind::choice) return setting.choice(json.get<std::string>());
  if (setting.kind == SettingKind::flag) return json.get<bool>();
  if (setting.kind == SettingKind::whole) return json.get<int>();
  return number_of(json);
}

/// Throws std::runtime_error with the group and the key for a setting that is missing or no value
/// of its kind.
void take_settings(const Json& json, std::string_view group,
                   const std::vector<SettingRef>& settings) {
  for (const SettingRef& setting : settings) {
    try {
      setting.set(value_of(json.at(std::string(setting.name)), setting));
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}.{}: {}", group, setting.name, error.what()));
    }
  }
}

constexpr std::string_view kCellFile = "cell.json";
constexpr std::string_view kSchema = "berth/recording/1";

Json json_of(const MountedCamera& mounted) {
  const CameraMount& mount = mounted.mount();
  Json json = {{"name", mount.name},
               {"parent_link", mount.parent_link},
               {"X_PC", exact(mount.X_PC)},
               {"width_px", mount.camera.width_px},
               {"height_px", mount.camera.height_px},
               {"fx_px", exact(mount.camera.fx_px)},
               {"fy_px", exact(mount.camera.fy_px)},
               {"cx_px", exact(mount.camera.cx_px)},
               {"cy_px", exact(mount.camera.cy_px)}};
  visit_setting_groups(mounted.settings(), [&](std::string_view group, const auto& settings) {
    json[group] = settings_json(setting_refs(settings));
  });
  json["link_padding_m"] = exact(mounted.settings().self_filter.link_padding_m);
  return json;
}

std::shared_ptr<const MountedCamera> mounted_of(const Json& json,
                                                const std::shared_ptr<const Robot>& robot) {
  CameraMount mount;
  mount.name = json.at("name").get<std::string>();
  mount.parent_link = json.at("parent_link").get<std::string>();
  mount.X_PC = pose_of(json.at("X_PC"));
  mount.camera = {json.at("width_px").get<int>(), json.at("height_px").get<int>(),
                  number_of(json.at("fx_px")),    number_of(json.at("fy_px")),
                  number_of(json.at("cx_px")),    number_of(json.at("cy_px"))};
  CameraSettings settings;
  visit_setting_groups(settings, [&](std::string_view group, auto& one) {
    take_settings(json.at(std::string(group)), group, setting_refs(one));
  });
  settings.self_filter.link_padding_m = numbers_of(json.at("link_padding_m"));
  return std::make_shared<const MountedCamera>(robot, std::move(mount), std::move(settings));
}

Json json_of(const SeparationSettings& settings) {
  Json json = settings_json(setting_refs(settings));
  json["stopping"] = Json::array();
  for (const StoppingRow& row : settings.stopping) {
    json["stopping"].push_back({exact(row.speed_m_s), exact(row.time_s), exact(row.distance_m)});
  }
  return json;
}

SeparationSettings separation_of(const Json& json) {
  SeparationSettings settings;
  take_settings(json, "separation", setting_refs(settings));
  for (const Json& row : json.at("stopping")) {
    settings.stopping.push_back({number_of(row.at(0)), number_of(row.at(1)), number_of(row.at(2))});
  }
  validate(settings);
  return settings;
}

RecordedCell cell_of(const mcap::FileReader& file, const Json& json, std::string& version) {
  const auto schema = json.at("schema").get<std::string>();
  if (schema != kSchema) {
    throw std::runtime_error(fmt::format("schema: {}; expected {}", schema, kSchema));
  }
  RecordedCell cell;
  cell.version = version = json.at("berth").get<std::string>();
  EvaluationSettings evaluation;
  take_settings(json.at("evaluation"), "evaluation", setting_refs(evaluation));
  take_settings(json.at("time"), "time", setting_refs(evaluation.time));
  cell.had_deadline = evaluation.distance.deadline_us.has_value();
  if (cell.had_deadline) {
    evaluation.distance.deadline_us = std::numeric_limits<double>::infinity();
  }
  cell.robot = read_robot(file, evaluation);
  for (const Json& camera : json.at("cameras"))
    cell.cameras.push_back(mounted_of(camera, cell.robot));
  if (!json.at("separation").is_null()) cell.separation = separation_of(json.at("separation"));
  return cell;
}

}  // namespace

std::vector<mcap::Attachment> attachments_of(const RecordedCell& cell) {
  Json json = {{"schema", kSchema}, {"berth", cell.version}};
  const EvaluationSettings& evaluation = cell.robot->settings();
  json["evaluation"] = settings_json(setting_refs(evaluation));
  json["time"] = settings_json(setting_refs(evaluation.time));
  json["cameras"] = Json::array();
  for (const auto& mounted : cell.cameras) json["cameras"].push_back(json_of(*mounted));
  json["separation"] = cell.separation ? json_of(*cell.separation) : Json();
  std::vector<mcap::Attachment> out{{std::string(kCellFile), "application/json", json.dump(1)}};
  append_robot(*cell.robot, out);
  return out;
}

RecordedCell read_cell(const mcap::FileReader& file) {
  const std::string& text = file.attachment(kCellFile).data;
  std::string version = BERTH_VERSION;
  try {
    return cell_of(file, Json::parse(text), version);
  } catch (const BadFile&) {
    throw;
  } catch (const std::exception& error) {
    file.fail_with(version == BERTH_VERSION
                       ? "robot or settings"
                       : fmt::format("robot or settings, by berth {}, read by berth {}", version,
                                     BERTH_VERSION),
                   error.what());
  }
}

}  // namespace berth
