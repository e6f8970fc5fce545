#pragma once

#include <string>
#include <vector>

#include "berth/robot/joints_at_time.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// Joint states over time, in the order of a robot's joints.
class JointTrajectory {
 public:
  /// Where the joints were at a time; rad, or m for prismatic joints.
  struct Sample {
    double time_s = 0;
    std::vector<double> positions;  ///< one for each name
  };

  /// `names` are URDF joints in any order, `samples` at least one, with increasing times. The
  /// positions of mimic joints are accepted and not used, since those follow their masters. Throws
  /// std::runtime_error that begins with `source` (a file's name): a name that is no joint of the
  /// robot or a fixed one, a joint of the robot that is missing.
  JointTrajectory(const RobotModel& model, std::string source,
                  const std::vector<std::string>& names, const std::vector<Sample>& samples);

  /// See joints_at_time().
  FrameTime at(double time_s, const JointTimeLimits& limits, JointState& joints) const;
  /// How fast each joint moves at a time: the slope between the two samples around it, rad/s or
  /// m/s. All are NaN outside of the samples. Reuses the memory of `velocity`.
  void velocity(double time_s, std::vector<double>& velocity) const;
  /// What the constructor was given.
  const std::string& source() const { return source_; }
  double first_s() const { return states_.front().stamp_s; }
  double last_s() const { return states_.back().stamp_s; }
  /// Throws std::runtime_error where there is no such sample; the first is 0.
  const JointState& sample(std::size_t index) const;
  std::size_t size() const { return states_.size(); }

 private:
  std::string source_;
  std::vector<bool> is_continuous_;
  std::vector<JointState> states_;
};

}  // namespace berth
