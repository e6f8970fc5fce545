// A monitor that several threads may ask, one after another.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "berth/record/monitor_loop.hpp"

namespace berth::python {

class SharedMonitor {
 public:
  SharedMonitor(std::shared_ptr<const Robot> robot, SeparationSettings settings)
      : monitor_(std::move(robot), std::move(settings)) {}

  /// Null: nothing is recorded.
  Separation update(Recorder* recorder, const Result& result, const PlannedMotion& motion,
                    double now_s, const FrameSet& frames) {
    const std::lock_guard lock(mutex_);
    return update_recorded(recorder, monitor_, result, motion, now_s, &frames);
  }
  SeparationSettings settings() const { return monitor_.settings(); }

 private:
  std::mutex mutex_;
  SeparationMonitor monitor_;
};

}  // namespace berth::python
