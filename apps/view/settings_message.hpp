#pragma once

#include "apps/view/changed_scene.hpp"
#include "apps/view/page_message.hpp"

namespace berth::app {

/// All settings of a scene and its cameras' poses: of each setting its name, unit, what it may be,
/// its sentence, what it is now and in the file.
PageMessage settings_message(const ChangedScene& scene);

}  // namespace berth::app
