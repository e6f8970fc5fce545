// Inside io/ only: one entry of a scene's cameras.
#pragma once

#include "berth/io/scene.hpp"
#include "berth/io/yaml_value.hpp"

namespace berth {

/// Throws as read_scene does.
SceneCamera read_scene_camera(const YamlValue& value);

}  // namespace berth
