// What a controller hears, and what it heard last.
#pragma once

#include <atomic>
#include <berth_msgs/msg/distance_rows.hpp>
#include <berth_msgs/msg/link_distances.hpp>
#include <berth_msgs/msg/separation.hpp>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_msgs/msg/float64.hpp>
#include <std_msgs/msg/float64_multi_array.hpp>
#include <string>
#include <vector>

namespace berth_ros {

/// The topics `speed_scale`, `separation`, `distances` and `distance_rows`, and a controller's
/// velocities. A robot obeys the last scale and the last velocities that it heard: so a stop goes
/// out at once, an answer that was begun before it does not come after it, and the last ones are 0
/// where no more are to come. Any thread may speak.
class AnswerTopics {
 public:
  using LinkDistances = berth_msgs::msg::LinkDistances;
  using Separation = berth_msgs::msg::Separation;
  using Velocities = std_msgs::msg::Float64MultiArray;
  /// What one result says.
  struct Answer {
    std::shared_ptr<const LinkDistances> distances = std::make_shared<LinkDistances>();
    Separation separation;
    /// None: nobody listens.
    std::optional<berth_msgs::msg::DistanceRows> rows;
    /// Filtered ones; none without a filter.
    Velocities velocities;
  };
  /// Who hears no scale for so long has to take it for 0: the deadline of `speed_scale`.
  static constexpr std::chrono::milliseconds kDeadline{100};

  /// `command_topic` is for filtered velocities; empty: there are none.
  AnswerTopics(rclcpp_lifecycle::LifecycleNode& node, std::vector<std::string> camera_names,
               std::string command_topic)
      : node_(node),
        camera_names_(std::move(camera_names)),
        command_topic_(std::move(command_topic)) {}

  void configure();
  void clean();
  /// Until end() something may be said.
  void begin();
  /// To be asked before an answer is begun, and told with it.
  std::int64_t stops() const { return stops_; }
  /// An answer of this many stops before: nothing is said where another one came meanwhile.
  void say(std::int64_t stops, const Answer& answer);
  /// Whether anybody listens to `distance_rows`.
  bool needs_rows() const { return rows_publisher_->get_subscription_count() > 0; }
  /// No distances, and a stop where speeds are monitored.
  void stop(const std::string& why, bool is_monitored);
  /// A stop, and nothing after it.
  void end(const std::string& why, bool is_monitored);
  /// Whether a stop was said since the last call: the scale rises from 0.
  bool was_stopped() { return was_stopped_.exchange(false); }
  /// Since anything was said, or begin().
  double silent_s() const;

  /// What was said last.
  std::shared_ptr<const LinkDistances> distances() const;
  std::string text() const;

 private:
  template <class Message>
  using Publisher = typename rclcpp_lifecycle::LifecyclePublisher<Message>::SharedPtr;

  // With the mutex.
  void say_stop_now(const std::string& why, bool is_monitored);
  void publish();

  rclcpp_lifecycle::LifecycleNode& node_;
  std::vector<std::string> camera_names_;
  std::string command_topic_;
  std::atomic<std::int64_t> stops_ = 0;
  std::atomic<bool> was_stopped_ = true;
  mutable std::mutex mutex_;
  bool may_speak_ = false;
  /// The scale that was heard last is not a last one.
  bool has_scale_ = false;
  std::chrono::steady_clock::time_point said_;
  Answer last_;
  Publisher<LinkDistances> distances_publisher_;
  Publisher<Separation> separation_publisher_;
  Publisher<std_msgs::msg::Float64> scale_publisher_;
  Publisher<berth_msgs::msg::DistanceRows> rows_publisher_;
  Publisher<Velocities> velocities_publisher_;
};

}  // namespace berth_ros
