#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/query.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

class Recorder;

/// What a controller does in each of its periods: a request, and the monitor's verdict on its
/// result, both recorded where there is a recorder. In one thread; once warm, nothing allocates.
///
///     loop.ask({.frames = space.newest(), .joints = joints, .now_s = now_s});
///     const Result& result = loop.monitor(motion, now_s);
class MonitorLoop {
 public:
  /// `camera_names` as for Query. Without settings nothing is monitored. Throws
  /// std::invalid_argument as SeparationMonitor does.
  MonitorLoop(std::shared_ptr<const Robot> robot, std::vector<std::string> camera_names = {},
              const std::optional<SeparationSettings>& separation = {});

  /// From the next request on; null: nothing is recorded. The recorder is one of these cameras and
  /// settings, and outlives its use.
  void record_with(Recorder* recorder) { recorder_ = recorder; }

  /// As Query::ask.
  const Result& ask(const Request& request);
  /// The last result of ask(), with Result::separation where there is a monitor. See
  /// SeparationMonitor::update; without frames it goes by the formula alone. Valid until the next
  /// call.
  const Result& monitor(const PlannedMotion& motion, double now_s, bool with_frames = true);

  /// Somebody else stopped the robot at this time: the scale rises from 0, as fast as the robot
  /// gains speed.
  void stopped(double now_s);

  bool has_monitor() const { return monitor_.has_value(); }
  /// As in Query.
  void forget() { query_.forget(); }
  const FrameSet& frames() const { return query_.frames(); }

 private:
  Query query_;
  std::optional<SeparationMonitor> monitor_;
  Recorder* recorder_ = nullptr;
  const Result* asked_ = nullptr;
  Result monitored_;
};

/// SeparationMonitor::update, recorded unless `recorder` is null.
const Separation& update_recorded(Recorder* recorder, SeparationMonitor& monitor,
                                  const Result& result, const PlannedMotion& motion, double now_s,
                                  const FrameSet* frames);

}  // namespace berth
