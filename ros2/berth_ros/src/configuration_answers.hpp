// What planners ask about configurations that the robot may take.
#pragma once

#include <berth_msgs/srv/check_configurations.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/configuration_check.hpp"
#include "stamp_clock.hpp"

namespace berth_ros {

/// The robot with its newest images and joints, as they are at `now_s`.
struct RobotNow {
  std::shared_ptr<const berth::Robot> robot;
  /// Of each camera, or null where it has none yet.
  std::vector<std::shared_ptr<const berth::Frame>> frames;
  berth::JointState joints = {};
  berth::TimeStatus joints_status = berth::TimeStatus::no_joints;
  /// Where the root stands: none where it does not move, not finite where nobody knows.
  std::optional<berth::Pose> X_WB = std::nullopt;
  double now_s = 0;
};

/// Answers one request after another.
class ConfigurationAnswers {
 public:
  using Request = berth_msgs::srv::CheckConfigurations::Request;
  using Response = berth_msgs::srv::CheckConfigurations::Response;
  /// Throws std::exception where nothing can be said.
  using Look = std::function<RobotNow()>;

  ConfigurationAnswers(std::vector<std::string> camera_names, const StampClock& clock, Look look)
      : camera_names_(std::move(camera_names)), clock_(clock), look_(std::move(look)) {}

  /// Throws nothing: what is wrong is the response's message. There are no verdicts while a camera
  /// is lost, since more would be free than with it.
  void answer(const Request& request, Response& response);

 private:
  void find(const Request& request, Response& response);
  void prepare(const RobotNow& now);
  /// Which cameras are not relied on, and why.
  std::string trouble(const RobotNow& now) const;

  std::vector<std::string> camera_names_;
  const StampClock& clock_;
  Look look_;
  /// Of the robot that was asked about last.
  std::unique_ptr<berth::ConfigurationCheck> check_;
};

}  // namespace berth_ros
