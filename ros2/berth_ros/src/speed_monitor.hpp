// How fast the robot may go on, after each result.
#pragma once

#include <berth_msgs/msg/separation.hpp>
#include <optional>
#include <sensor_msgs/msg/joint_state.hpp>
#include <string>
#include <vector>

#include "berth/robot/joint_buffer.hpp"
#include "berth/separation/monitor.hpp"
#include "black_box.hpp"

namespace berth_ros {

/// The velocities that the robot's program wants, of its last message.
class PlannedVelocity {
 public:
  /// Joints of the robot that the message has no velocity for are NaN.
  void take(const sensor_msgs::msg::JointState& message, const berth::RobotModel& model,
            double now_s);
  /// Whether any message came.
  bool is_there() const { return !velocity_.empty(); }
  /// All NaN where the last message is older than max_age_s.
  const std::vector<double>& at(double now_s, double max_age_s);

 private:
  double stamp_s_ = 0;
  std::vector<double> velocity_;
};

/// berth::SeparationMonitor on messages. One for each robot and thread.
class SpeedMonitor {
 public:
  /// Throws as berth::SeparationMonitor does.
  SpeedMonitor(std::shared_ptr<const berth::Robot> robot, const berth::SeparationSettings& settings,
               double velocity_window_s);

  /// Sets Result::separation, and what is about speeds in `out`. Velocities are those of `planned`
  /// where any came, else those of the joints. `frames` are those that the result is about, which
  /// `black_box` was asked for.
  void update(BlackBox& black_box, berth::Result& result, const berth::JointBuffer& joints,
              PlannedVelocity& planned, double now_s, const berth::FrameSet& frames,
              berth_msgs::msg::Separation& out);

 private:
  std::shared_ptr<const berth::Robot> robot_;
  berth::SeparationMonitor monitor_;
  double velocity_window_s_;
  std::vector<double> velocity_;
};

/// That nothing is monitored.
void say_unmonitored(berth_msgs::msg::Separation& out);

/// That there is nothing to monitor yet: a stop.
void say_stop(const std::string& text, berth_msgs::msg::Separation& out);

}  // namespace berth_ros
