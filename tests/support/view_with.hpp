// A view once more, with other settings.
#pragma once

#include <memory>

#include "berth/pipeline/mounted_camera.hpp"

namespace berth::testing {

inline std::shared_ptr<const MountedCamera> view_with(const MountedCamera& view,
                                                      const CameraSettings& settings) {
  return std::make_shared<const MountedCamera>(view.robot(), view.mount(), settings);
}

/// Of a robot of its own.
inline std::shared_ptr<const MountedCamera> view_with(const MountedCamera& view,
                                                      const EvaluationSettings& evaluation,
                                                      const CameraSettings& settings) {
  return std::make_shared<const MountedCamera>(
      std::make_shared<const Robot>(view.robot()->model(), evaluation), view.mount(), settings);
}

}  // namespace berth::testing
