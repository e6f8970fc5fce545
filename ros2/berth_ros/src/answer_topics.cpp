#include "answer_topics.hpp"

#include <algorithm>

#include "result_messages.hpp"
#include "speed_monitor.hpp"

namespace berth_ros {

void AnswerTopics::configure() {
  const rclcpp::QoS qos(10);
  distances_publisher_ = node_.create_publisher<LinkDistances>("distances", qos);
  separation_publisher_ = node_.create_publisher<Separation>("separation", qos);
  scale_publisher_ = node_.create_publisher<std_msgs::msg::Float64>(
      "speed_scale", rclcpp::QoS(10).deadline(kDeadline));
  rows_publisher_ = node_.create_publisher<berth_msgs::msg::DistanceRows>("distance_rows", qos);
  if (command_topic_.empty()) return;
  velocities_publisher_ =
      node_.create_publisher<Velocities>(command_topic_, rclcpp::QoS(1).deadline(kDeadline));
}

void AnswerTopics::clean() {
  distances_publisher_.reset();
  separation_publisher_.reset();
  scale_publisher_.reset();
  rows_publisher_.reset();
  velocities_publisher_.reset();
}

void AnswerTopics::begin() {
  const std::lock_guard lock(mutex_);
  may_speak_ = true;
  said_ = std::chrono::steady_clock::now();
}

void AnswerTopics::say(std::int64_t stops, const Answer& answer) {
  const std::lock_guard lock(mutex_);
  if (!may_speak_ || stops != stops_) return;
  last_ = answer;
  publish();
}

void AnswerTopics::stop(const std::string& why, bool is_monitored) {
  const std::lock_guard lock(mutex_);
  say_stop_now(why, is_monitored);
}

void AnswerTopics::end(const std::string& why, bool is_monitored) {
  const std::lock_guard lock(mutex_);
  say_stop_now(why, is_monitored);
  may_speak_ = false;
}

void AnswerTopics::say_stop_now(const std::string& why, bool is_monitored) {
  ++stops_;
  was_stopped_ = true;
  if (!may_speak_) return;
  auto distances = std::make_shared<LinkDistances>();
  say_no_robot(camera_names_, node_.now(), *distances);
  say_unmonitored(last_.separation);
  last_.separation.text = "stale: " + why;
  if (is_monitored) say_stop(why, last_.separation);
  to_message(*distances, false, last_.separation);
  last_.rows.emplace();
  last_.rows->header = distances->header;
  last_.rows->question_stamp = distances->question_stamp;
  last_.rows->status = distances->status;
  std::ranges::fill(last_.velocities.data, 0.0);
  last_.distances = std::move(distances);
  publish();
}

void AnswerTopics::publish() {
  const bool is_monitored = last_.separation.state != Separation::UNMONITORED;
  // First, since who obeys them is not to wait for the others' readers. A last one is 0.
  if (!last_.velocities.data.empty()) velocities_publisher_->publish(last_.velocities);
  if (is_monitored || has_scale_) {
    std_msgs::msg::Float64 scale;
    scale.data = is_monitored ? last_.separation.speed_scale : 0;
    scale_publisher_->publish(scale);
  }
  has_scale_ = is_monitored;
  separation_publisher_->publish(last_.separation);
  distances_publisher_->publish(*last_.distances);
  if (last_.rows) rows_publisher_->publish(*last_.rows);
  said_ = std::chrono::steady_clock::now();
}

double AnswerTopics::silent_s() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - said_).count();
}

std::shared_ptr<const AnswerTopics::LinkDistances> AnswerTopics::distances() const {
  const std::lock_guard lock(mutex_);
  return last_.distances;
}

std::string AnswerTopics::text() const {
  const std::lock_guard lock(mutex_);
  return last_.separation.text;
}

}  // namespace berth_ros
