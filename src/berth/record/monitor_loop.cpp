#include "berth/record/monitor_loop.hpp"

#include <cassert>
#include <utility>

#include "berth/record/recorder.hpp"

namespace berth {

MonitorLoop::MonitorLoop(std::shared_ptr<const Robot> robot, std::vector<std::string> camera_names,
                         const std::optional<SeparationSettings>& separation)
    : query_(robot, std::move(camera_names)) {
  if (separation) monitor_.emplace(std::move(robot), *separation);
}

const Result& MonitorLoop::ask(const Request& request) {
  asked_ = recorder_ ? &recorder_->ask(query_, request) : &query_.ask(request);
  return *asked_;
}

const Result& MonitorLoop::monitor(const PlannedMotion& motion, double now_s, bool with_frames) {
  assert(asked_ && "a result of ask()");
  if (!monitor_) return *asked_;
  // The query's result has no separation: a plain copy would free the memory of the one before.
  std::optional<Separation> before = std::move(monitored_.separation);
  monitored_ = *asked_;
  monitored_.separation = std::move(before);
  monitored_.separation = update_recorded(recorder_, *monitor_, *asked_, motion, now_s,
                                          with_frames ? &query_.frames() : nullptr);
  return monitored_;
}

void MonitorLoop::stopped(double now_s) {
  if (monitor_) monitor_->recall({.is_first = false, .scale = 0, .last_s = now_s});
}

const Separation& update_recorded(Recorder* recorder, SeparationMonitor& monitor,
                                  const Result& result, const PlannedMotion& motion, double now_s,
                                  const FrameSet* frames) {
  return recorder ? recorder->update(monitor, result, motion, now_s, frames)
                  : monitor.update(result, motion, now_s, frames);
}

}  // namespace berth
