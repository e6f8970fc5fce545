// Inside scene/ only: one entry of a scene's cameras.
#pragma once

#include "berth/files/yaml_value.hpp"
#include "berth/scene/scene_file.hpp"

namespace berth {

/// `settings` are those of the scene. Throws as read_scene does.
SceneCamera read_scene_camera(const YamlValue& value, const CameraSettings& settings);

/// The pose of a map with xyz and one of the two rotations.
Pose read_pose(const YamlMap& pose);

/// The maps self_filter, sensor, space and watch of a scene or a camera, over `settings`.
void read_view_settings(const YamlMap& map, CameraSettings& settings);

}  // namespace berth
