#include "transforms.hpp"

#include <algorithm>
#include <limits>
#include <tf2_eigen/tf2_eigen.hpp>

namespace berth_ros {
namespace {

/// TF's tree may be deep, and for a moment have a loop.
constexpr std::size_t kMostFrames = 100;
/// Of one frame: at 1000 Hz, two seconds.
constexpr std::size_t kMostStamps = 2000;

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

bool contains(const std::vector<std::string>& frames, const std::string& frame) {
  return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

}  // namespace

Transforms::Transforms(rclcpp_lifecycle::LifecycleNode& node,
                       const std::shared_ptr<CallbackGate>& gate, std::function<void()> on_change)
    : buffer_(node.get_clock()), on_change_(std::move(on_change)) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = node.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  // Within a process, Humble has no transient local.
  options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
  using tf2_msgs::msg::TFMessage;
  moving_ = node.create_subscription<TFMessage>(
      "/tf", rclcpp::QoS(100),
      [this, gate](const TFMessage& message) {
        if (const auto pass = gate->enter()) take(message, false);
      },
      options);
  static_ = node.create_subscription<TFMessage>(
      "/tf_static", rclcpp::QoS(100).transient_local(),
      [this, gate](const TFMessage& message) {
        if (const auto pass = gate->enter()) take(message, true);
      },
      options);
}

void Transforms::take(const tf2_msgs::msg::TFMessage& message, bool is_static) {
  {
    const std::lock_guard lock(mutex_);
    for (const auto& transform : message.transforms) {
      if (!buffer_.setTransform(transform, "berth", is_static) || is_static) continue;
      auto& stamps = told_[without_slash(transform.child_frame_id)];
      const std::int64_t stamp_ns = rclcpp::Time(transform.header.stamp).nanoseconds();
      // Late ones among the others; those of a clock that was set back after all others.
      const auto after = std::upper_bound(stamps.begin(), stamps.end(), stamp_ns);
      stamps.insert(after, stamp_ns);
      if (stamps.size() > kMostStamps) stamps.pop_front();
    }
  }
  on_change_();
}

std::vector<std::string> Transforms::ancestors(std::string frame) const {
  std::vector<std::string> frames = {frame};
  std::string parent;
  while (frames.size() < kMostFrames &&
         buffer_._getParent(frames.back(), tf2::TimePointZero, parent)) {
    frames.push_back(parent);
  }
  return frames;
}

std::vector<std::string> Transforms::moving_between(const std::string& parent,
                                                    const std::string& frame) const {
  const std::vector<std::string> above_parent = ancestors(without_slash(parent));
  const std::vector<std::string> above_frame = ancestors(without_slash(frame));
  std::vector<std::string> moving;
  const auto add = [&](const auto& of, const auto& others) {
    for (const std::string& one : of) {
      if (!contains(others, one) && told_.count(one) > 0) moving.push_back(one);
    }
  };
  add(above_parent, above_frame);
  add(above_frame, above_parent);
  return moving;
}

double Transforms::gap_s(const std::string& frame, const rclcpp::Time& stamp) const {
  const auto& stamps = told_.at(frame);
  const std::int64_t at_ns = stamp.nanoseconds();
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), at_ns);
  std::int64_t gap_ns = std::numeric_limits<std::int64_t>::max();
  if (after != stamps.end()) gap_ns = *after - at_ns;
  if (after != stamps.begin()) gap_ns = std::min(gap_ns, at_ns - after[-1]);
  return static_cast<double>(gap_ns) * 1e-9;
}

std::optional<ToldPose> Transforms::at(const std::string& parent, const std::string& frame,
                                       const rclcpp::Time& stamp, double max_gap_s,
                                       std::string& why) const {
  try {
    const auto transform = buffer_.lookupTransform(
        parent, frame, tf2::TimePoint(std::chrono::nanoseconds(stamp.nanoseconds())));
    const std::lock_guard lock(mutex_);
    const std::vector<std::string> moving = moving_between(parent, frame);
    for (const std::string& one : moving) {
      const double told_within_s = gap_s(one, stamp);
      if (told_within_s <= max_gap_s) continue;
      why = "TF told the frame " + one + " at no time within " + std::to_string(max_gap_s) +
            " s of the exposure";
      return std::nullopt;
    }
    return ToldPose{tf2::transformToEigen(transform), moving.empty(), stamp};
  } catch (const tf2::TransformException& error) {
    why = "no transform from " + parent + " to " + frame + " at the exposure: " + error.what();
    return std::nullopt;
  }
}

std::optional<ToldPose> Transforms::newest(const std::string& parent, const std::string& frame,
                                           std::string& why) const {
  try {
    const auto transform = buffer_.lookupTransform(parent, frame, tf2::TimePointZero);
    const std::lock_guard lock(mutex_);
    return ToldPose{tf2::transformToEigen(transform), moving_between(parent, frame).empty(),
                    transform.header.stamp};
  } catch (const tf2::TransformException& error) {
    why = "no transform from " + parent + " to " + frame + ": " + error.what();
    return std::nullopt;
  }
}

std::string Transforms::link_above(const berth::RobotModel& model, const std::string& frame) const {
  const std::vector<std::string> frames = ancestors(without_slash(frame));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (model.find_link(frames[i])) return frames[i];
  }
  return model.links.front().name;
}

bool is_same_place(const berth::Pose& a, const berth::Pose& b) {
  const berth::Pose between = a.inverse() * b;
  return between.translation().norm() <= 1e-4 &&
         Eigen::AngleAxisd(between.linear()).angle() <= 1e-4;
}

}  // namespace berth_ros
