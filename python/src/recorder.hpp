// A recorder that several threads may ask by, one after another.
#pragma once

#include <mutex>
#include <utility>

#include "berth/record/recorder.hpp"

namespace berth::python {

struct SharedRecorder {
  SharedRecorder(std::shared_ptr<const Robot> robot,
                 std::vector<std::shared_ptr<const MountedCamera>> cameras,
                 std::optional<SeparationSettings> separation, RecorderSettings settings)
      : recorder(std::move(robot), std::move(cameras), std::move(separation), std::move(settings)) {
  }

  std::mutex mutex;
  Recorder recorder;
};

}  // namespace berth::python
