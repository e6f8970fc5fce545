#include "transforms.hpp"

#include <algorithm>
#include <limits>
#include <tf2_eigen/tf2_eigen.hpp>

#include "stamp_clock.hpp"

namespace berth_ros {
namespace {

/// TF's tree may be deep, and for a moment have a loop.
constexpr std::size_t kMostFrames = 100;
/// Of one frame: at 1000 Hz, two seconds.
constexpr std::size_t kMostStamps = 2000;
constexpr double kFarthest_m = 1e6;

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

/// Of TF's numbers, which may be any. Throws std::invalid_argument for what is no pose of a robot's
/// surroundings.
berth::Pose require_pose(const geometry_msgs::msg::TransformStamped& transform) {
  const berth::Pose X_PF = tf2::transformToEigen(transform);
  if (X_PF.matrix().allFinite() && X_PF.translation().norm() <= kFarthest_m) return X_PF;
  throw std::invalid_argument("not finite, or farther away than 1000 km");
}

bool contains(const std::vector<std::string>& frames, const std::string& frame) {
  return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

}  // namespace

Transforms::Transforms(rclcpp_lifecycle::LifecycleNode& node,
                       const std::shared_ptr<CallbackGate>& gate, std::function<void()> on_change,
                       std::function<void(const std::string& frame)> on_set_back)
    : buffer_(node.get_clock()),
      on_change_(std::move(on_change)),
      on_set_back_(std::move(on_set_back)) {
  rclcpp::SubscriptionOptions options;
  options.callback_group = node.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  // Within a process, Humble has no transient local.
  options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
  using tf2_msgs::msg::TFMessage;
  moving_ = node.create_subscription<TFMessage>(
      "/tf", rclcpp::QoS(100),
      [this, gate](const TFMessage& message) { gate->run([&] { take(message, false); }); },
      options);
  static_ = node.create_subscription<TFMessage>(
      "/tf_static", rclcpp::QoS(100).transient_local(),
      [this, gate](const TFMessage& message) { gate->run([&] { take(message, true); }); }, options);
}

void Transforms::forget() {
  const std::lock_guard lock(mutex_);
  buffer_.clear();
  told_.clear();
}

void Transforms::take(const tf2_msgs::msg::TFMessage& message, bool is_static) {
  std::string trouble;
  for (const auto& transform : message.transforms) {
    try {
      take(transform, is_static);
    } catch (const std::exception& error) {
      trouble = "transform of " + transform.child_frame_id + ": " + error.what();
    }
  }
  on_change_();
  if (!trouble.empty()) throw std::invalid_argument(trouble);
}

void Transforms::take(const geometry_msgs::msg::TransformStamped& transform, bool is_static) {
  if (is_static) {
    buffer_.setTransform(transform, "berth", true);
    return;
  }
  const std::string frame = without_slash(transform.child_frame_id);
  const std::int64_t stamp_ns = StampClock::nanoseconds(transform.header.stamp);
  if (is_set_back(frame, stamp_ns)) on_set_back_(frame);
  const std::lock_guard lock(mutex_);
  if (!buffer_.setTransform(transform, "berth", false)) return;
  auto& stamps_ns = told_[frame].stamps_ns;
  // Late ones among the others.
  stamps_ns.insert(std::upper_bound(stamps_ns.begin(), stamps_ns.end(), stamp_ns), stamp_ns);
  if (stamps_ns.size() > kMostStamps) stamps_ns.pop_front();
}

bool Transforms::is_set_back(const std::string& frame, std::int64_t stamp_ns) {
  const std::lock_guard lock(mutex_);
  const auto told = told_.find(frame);
  if (told == told_.end()) return false;
  const auto behind_ns = static_cast<double>(told->second.stamps_ns.back() - stamp_ns);
  return told->second.behind.is_set_back(1e-9 * behind_ns) && told->second.is_used;
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
      const auto told = told_.find(one);
      if (contains(others, one) || told == told_.end()) continue;
      told->second.is_used = true;
      moving.push_back(one);
    }
  };
  add(above_parent, above_frame);
  add(above_frame, above_parent);
  return moving;
}

double Transforms::gap_s(const std::string& frame, const rclcpp::Time& stamp) const {
  const auto& stamps = told_.at(frame).stamps_ns;
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
    const std::lock_guard lock(mutex_);
    const auto transform = buffer_.lookupTransform(
        parent, frame, tf2::TimePoint(std::chrono::nanoseconds(stamp.nanoseconds())));
    const std::vector<std::string> moving = moving_between(parent, frame);
    for (const std::string& one : moving) {
      const double told_within_s = gap_s(one, stamp);
      if (told_within_s <= max_gap_s) continue;
      why = "TF told the frame " + one + " at no time within " + std::to_string(max_gap_s) +
            " s of the exposure";
      return std::nullopt;
    }
    return ToldPose{require_pose(transform), moving.empty(), stamp};
  } catch (const std::exception& error) {
    why = "no transform from " + parent + " to " + frame + " at the exposure: " + error.what();
    return std::nullopt;
  }
}

std::optional<ToldPose> Transforms::newest(const std::string& parent, const std::string& frame,
                                           std::string& why) const {
  try {
    const std::lock_guard lock(mutex_);
    const auto transform = buffer_.lookupTransform(parent, frame, tf2::TimePointZero);
    return ToldPose{require_pose(transform), moving_between(parent, frame).empty(),
                    transform.header.stamp};
  } catch (const std::exception& error) {
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
