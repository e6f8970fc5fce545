#pragma once

#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "berth/robot/joints_at_time.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// The newest joint samples of a running robot, for images whose exposure lies among them. One
/// thread may push while others look up. Its memory is bounded; once it is full, nothing allocates.
class JointBuffer {
 public:
  /// `capacity` samples are kept, at least 2: at 1000 Hz, 500 are half a second. Throws
  /// std::invalid_argument for less.
  JointBuffer(const RobotModel& model, std::size_t capacity);

  /// Adds a sample; positions in rad or m, one for each name, in any order. Names that are no
  /// joints of the robot are passed over. Two kinds of samples are not kept: one that lacks a joint
  /// of the robot or has a position that is not finite (missing_joint; missing_joint() names the
  /// joint), and one whose stamp is not above the newest (stamp_went_back). If the clock was set
  /// back, call clear(): only the caller can tell that from a late sample. Throws
  /// std::invalid_argument where names and positions are not equally many.
  TimeStatus push(double stamp_s, std::span<const std::string> names,
                  std::span<const double> positions);

  /// The joints at a time among the samples: see joints_at_time(). Where the time lies after the
  /// newest sample because the one pushed last lacked a joint, that is the status.
  FrameTime at(double time_s, const JointTimeLimits& limits, JointState& joints) const;

  /// The newest sample with its own stamp; its status is ok, no_joints or, where the one pushed
  /// last lacked a joint, missing_joint, and then `joints` is NaN.
  TimeStatus newest(JointState& joints) const;

  /// How fast the joints move at the newest sample: its way from the last sample that is at least
  /// `window_s` older (from the oldest, where none is), over the time between; rad/s or m/s, one
  /// for each joint. It lags by half of the window. Where there are not two samples (no_joints), or
  /// the one pushed last lacked a joint (missing_joint), all are NaN.
  TimeStatus velocity(double window_s, std::vector<double>& velocity) const;

  /// Of the newest sample; NaN where there is none.
  double newest_stamp_s() const;

  /// The joint that the sample pushed last lacked; empty where it lacked none.
  std::string missing_joint() const;

  void clear();

 private:
  void keep(double stamp_s);

  mutable std::mutex mutex_;
  std::vector<std::string> names_;
  std::vector<bool> is_continuous_;
  std::size_t capacity_;
  /// Increasing stamps.
  std::vector<JointState> samples_;
  std::vector<double> incoming_;
  std::string_view missing_;
};

}  // namespace berth
