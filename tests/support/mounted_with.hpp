// A view once more, with other settings.
#pragma once

#include <memory>

#include "berth/pipeline/mounted_camera.hpp"

namespace berth::testing {

inline std::shared_ptr<const MountedCamera> mounted_with(const MountedCamera& mounted,
                                                         const CameraSettings& settings) {
  return std::make_shared<const MountedCamera>(mounted.robot(), mounted.mount(), settings);
}

/// Of a robot of its own.
inline std::shared_ptr<const MountedCamera> mounted_with(const MountedCamera& mounted,
                                                         const EvaluationSettings& evaluation,
                                                         const CameraSettings& settings) {
  return std::make_shared<const MountedCamera>(
      std::make_shared<const Robot>(mounted.robot()->model(), evaluation), mounted.mount(),
      settings);
}

}  // namespace berth::testing
