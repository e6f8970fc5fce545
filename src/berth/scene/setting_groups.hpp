// Inside scene/ only: all maps of settings in a scene file, as it finds them where it says nothing.
#pragma once

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

}  // namespace berth
