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
  /// positions of mimic joints are accepted and not used, since those follow their masters, and so
  /// are those of names that are no joint of the robot or a fixed one. Throws std::runtime_error
  /// that begins with `source` (a file's name): a joint of the robot that is missing.
  JointTrajectory(const RobotModel& model, std::string source,
                  const std::vector<std::string>& names, const std::vector<Sample>& samples);

  /// See joints_at_time(). Between two samples that agree the robot stood still, however far away
  /// they are.
  FrameTime at(double time_s, const JointTimeLimits& limits, JointState& joints) const;
  /// How fast each joint moves at a time: the slope between the two samples around it, rad/s or
  /// m/s. All are NaN outside of the samples. Reuses the memory of `velocity`.
  void velocity(double time_s, std::vector<double>& velocity) const;
  /// What the constructor was given.
  const std::string& source() const { return source_; }
  double first_s() const { return states_.front().stamp_s; }
  double last_s() const { return states_.back().stamp_s; }
  /// The first is 0; below size().
  const JointState& sample(std::size_t index) const { return states_[index]; }
  std::size_t size() const { return states_.size(); }
  /// Whether no joint leaves the place of the first sample.
  bool stands_still() const;
  /// One sentence each: names that are not used, joints that jump, positions outside of the URDF's
  /// limits.
  std::vector<std::string> doubts(const RobotModel& model) const;

 private:
  /// Whether any joint differs between the samples around.
  bool moves_at(double time_s) const;
  /// The first jump of joint i, or nothing.
  std::string jump_of(const MovableJoint& joint, std::size_t i) const;

  std::string source_;
  std::vector<std::string> unused_;
  std::vector<bool> is_continuous_;
  std::vector<JointState> states_;
};

}  // namespace berth
