// What the documents say of the settings, made from the lists of settings themselves.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/robot/joints_at_time.hpp"
#include "berth/separation/settings.hpp"

namespace berth {

/// visit(name of the map, its settings), in the order of kSettingGroups.
template <class Visitor>
void visit_scene_groups(Visitor&& visit) {
  const CameraSettings camera = settings_of_real_camera();
  visit_setting_groups(camera, visit);
  visit(std::string_view("evaluation"), EvaluationSettings());
  // What read_scene() begins with.
  TimeSettings time;
  time.joints = kInRecordings;
  visit(std::string_view("time"), time);
  visit(std::string_view("separation"), SeparationSettings());
}

/// The maps of settings in a scene file.
inline constexpr std::array<std::string_view, 7> kSettingGroups = {
    "self_filter", "sensor", "space", "watch", "evaluation", "time", "separation"};

/// A Markdown table of one of these maps: key, default in a scene file, values that it may have,
/// what it does. Ends in a line break. Throws std::invalid_argument for another group.
std::string settings_table(std::string_view group);

}  // namespace berth
