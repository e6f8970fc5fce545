// How fast the robot may go on, after each result.
#pragma once

#include <berth_msgs/msg/separation.hpp>
#include <optional>
#include <sensor_msgs/msg/joint_state.hpp>
#include <string>
#include <vector>

#include "berth/pipeline/result.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth_ros {

/// The velocities that the robot's program wants, of its last message.
class PlannedVelocity {
 public:
  /// Of a message of this time. Joints of the robot that it has no velocity for are NaN.
  void take(const sensor_msgs::msg::JointState& message, const berth::RobotModel& model,
            double stamp_s);
  /// The robot is another one: where any message came, the next one is waited for.
  void begin_anew(const berth::RobotModel& model);
  /// Whether any message came.
  bool is_there() const { return !velocity_.empty(); }
  /// All NaN where the last message is older than max_age_s, or lies in the future.
  const std::vector<double>& at(double now_s, double max_age_s);

 private:
  double stamp_s_ = 0;
  std::vector<double> velocity_;
};

/// What Result::separation says, which is there.
void to_message(const berth::Result& result, bool is_planned, berth_msgs::msg::Separation& out);

/// That nothing is monitored.
void say_unmonitored(berth_msgs::msg::Separation& out);

/// That there is nothing to monitor yet: a stop.
void say_stop(const std::string& text, berth_msgs::msg::Separation& out);

}  // namespace berth_ros
