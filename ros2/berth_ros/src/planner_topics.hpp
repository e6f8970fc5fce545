// What planners read: the space around the robot on topics of its own, each with its own rate.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_msgs/msg/header.hpp>
#include <string>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/pipeline/space_map.hpp"
#include "callback_gate.hpp"
#include "stamp_clock.hpp"
#include "status_log.hpp"

namespace berth_ros {

/// The robot's newest frames, as they are at `now_s`.
struct SpaceNow {
  std::shared_ptr<const berth::Robot> robot;
  std::vector<std::shared_ptr<const berth::Frame>> frames;
  double now_s = 0;
};

/// While a camera is lost nothing is published: a map without it would clear what it saw.
class PlannerTopics {
 public:
  /// None while there is no robot, or the node is not to answer.
  using Look = std::function<std::optional<SpaceNow>()>;

  /// Declares the parameters. Throws std::exception for a bad one.
  PlannerTopics(rclcpp_lifecycle::LifecycleNode& node, const StampClock& clock, Look look);
  ~PlannerTopics();

  /// Makes the publishers of those topics that have a rate; callbacks pass this gate.
  void configure(std::shared_ptr<CallbackGate> gate);
  void activate();
  void deactivate();
  /// Ends the publishers.
  void clean();
  /// Whether any topic has a rate.
  bool is_on() const;
  /// Why nothing was published the last time: planners keep the map before. Empty where it was.
  std::string lost() const;

 private:
  struct Topic;
  template <class Message, class Make>
  void offer(const std::string& name, const std::string& what, Make make);
  void offer_octomaps();
  /// Declares the rate of a topic that this build does not have. Throws where it is not 0.
  void refuse(const std::string& name, const std::string& package);
  void publish(const Topic& topic);
  /// Why there is no map; empty where there is one.
  std::string trouble(const std::optional<SpaceNow>& now);

  rclcpp_lifecycle::LifecycleNode& node_;
  const StampClock& clock_;
  Look look_;
  double edge_m_ = 0;
  Eigen::AlignedBox3d box_B_m_;
  std::pair<double, double> heights_m_;
  bool hidden_is_occupied_ = false;
  std::vector<std::unique_ptr<Topic>> topics_;
  berth::SpaceMap map_;
  mutable std::mutex mutex_;
  std::string lost_;
  std::optional<StatusLog> log_;
  std::shared_ptr<CallbackGate> gate_;
  rclcpp::CallbackGroup::SharedPtr group_;
};

}  // namespace berth_ros
