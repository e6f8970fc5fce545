// Joint velocities on their way from a program to its controller.
#pragma once

#include <chrono>
#include <diagnostic_updater/diagnostic_updater.hpp>
#include <memory>
#include <mutex>
#include <span>
#include <std_msgs/msg/float64_multi_array.hpp>
#include <string>
#include <vector>

#include "berth/control/velocity_filter.hpp"

namespace berth_ros {

/// What a program wants, and what berth::VelocityFilter allows of it after each result. Messages
/// hold rad/s or m/s of the joints in their order. Any thread may call.
class VelocityCommands {
 public:
  using Message = std_msgs::msg::Float64MultiArray;
  /// Who says nothing for so long wants 0.
  static constexpr std::chrono::milliseconds kMostSilence{100};

  /// The joints of the controller; empty: all of the model's, in its order.
  explicit VelocityCommands(std::vector<std::string> joints) : joints_(std::move(joints)) {}

  /// The filter of one robot.
  struct Filter {
    std::unique_ptr<berth::VelocityFilter> filter;
    /// The places of the joints in RobotModel::joints.
    std::vector<std::size_t> places;
    /// Their names, for people.
    std::string names;
  };
  /// Throws std::invalid_argument for settings out of their domains, and for joints that the robot
  /// does not have.
  Filter make(const std::shared_ptr<const berth::Robot>& robot,
              const berth::VelocityFilterSettings& settings) const;
  /// From now on nothing is wanted until the next message.
  void use(Filter filter);

  void take(const Message& wanted);
  /// What is allowed after this result of the robot: 0 where nothing is, or nothing is wanted.
  /// Positions and velocities are those of the model's joints.
  void allow(const berth::Result& result, std::span<const double> position,
             std::span<const double> velocity, Message& out);
  /// The node says 0 in its place.
  void stopped(const std::string& why);

  /// Why nothing is allowed; empty: it is, or nothing is wanted.
  std::string trouble() const;
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  using Clock = std::chrono::steady_clock;
  /// What takes longer, or is older, than the filter was told; with the mutex.
  std::string doubt() const;

  std::vector<std::string> joints_;
  mutable std::mutex mutex_;
  Filter filter_;
  /// Of the last message, in its order; empty: there is none, or it was refused.
  std::vector<double> wanted_;
  Clock::time_point heard_;
  std::string refused_;
  /// Of all joints.
  std::vector<double> asked_;
  std::string trouble_;
  std::string held_by_;
  double scale_ = 0;
  Clock::time_point allowed_;
  /// Since the last report.
  double longest_s_ = 0;
  double oldest_joints_s_ = 0;
};

}  // namespace berth_ros
