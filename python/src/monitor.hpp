// A monitor that several threads may ask, one after another.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

#include "berth/record/recorder.hpp"
#include "berth/separation/monitor.hpp"

namespace berth::python {

class SharedMonitor {
 public:
  SharedMonitor(std::shared_ptr<const Robot> robot, SeparationSettings settings)
      : monitor_(std::move(robot), std::move(settings)) {}

  Separation update(const Result& result, const PlannedMotion& motion, double now_s,
                    const FrameSet& frames) {
    const std::lock_guard lock(mutex_);
    return monitor_.update(result, motion, now_s, &frames);
  }
  /// The same, recorded.
  Separation update(Recorder& recorder, const Result& result, const PlannedMotion& motion,
                    double now_s, const FrameSet& frames) {
    const std::lock_guard lock(mutex_);
    return recorder.update(monitor_, result, motion, now_s, &frames);
  }
  SeparationSettings settings() const { return monitor_.settings(); }

 private:
  std::mutex mutex_;
  SeparationMonitor monitor_;
};

}  // namespace berth::python
