#include "answer_topics.hpp"

#include "result_messages.hpp"
#include "speed_monitor.hpp"

namespace berth_ros {

void AnswerTopics::configure() {
  const rclcpp::QoS qos(10);
  distances_publisher_ = node_.create_publisher<LinkDistances>("distances", qos);
  separation_publisher_ = node_.create_publisher<Separation>("separation", qos);
  scale_publisher_ = node_.create_publisher<std_msgs::msg::Float64>(
      "speed_scale", rclcpp::QoS(10).deadline(kDeadline));
}

void AnswerTopics::clean() {
  distances_publisher_.reset();
  separation_publisher_.reset();
  scale_publisher_.reset();
}

void AnswerTopics::begin() {
  const std::lock_guard lock(mutex_);
  may_speak_ = true;
  said_ = std::chrono::steady_clock::now();
}

void AnswerTopics::say(std::int64_t stops, std::shared_ptr<const LinkDistances> distances,
                       const Separation& separation) {
  const std::lock_guard lock(mutex_);
  if (!may_speak_ || stops != stops_) return;
  separation_ = separation;
  publish(std::move(distances));
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
  say_unmonitored(separation_);
  separation_.text = "stale: " + why;
  if (is_monitored) say_stop(why, separation_);
  to_message(*distances, false, separation_);
  publish(std::move(distances));
}

void AnswerTopics::publish(std::shared_ptr<const LinkDistances> distances) {
  const bool is_monitored = separation_.state != Separation::UNMONITORED;
  // First, since who obeys it is not to wait for the others' readers. A last one is 0.
  if (is_monitored || has_scale_) {
    std_msgs::msg::Float64 scale;
    scale.data = is_monitored ? separation_.speed_scale : 0;
    scale_publisher_->publish(scale);
  }
  has_scale_ = is_monitored;
  separation_publisher_->publish(separation_);
  last_ = std::move(distances);
  distances_publisher_->publish(*last_);
  said_ = std::chrono::steady_clock::now();
}

double AnswerTopics::silent_s() const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - said_).count();
}

std::shared_ptr<const AnswerTopics::LinkDistances> AnswerTopics::distances() const {
  const std::lock_guard lock(mutex_);
  return last_;
}

std::string AnswerTopics::text() const {
  const std::lock_guard lock(mutex_);
  return separation_.text;
}

}  // namespace berth_ros
