// How long distance_node takes: plays a scene's images and joints at the rates asked for, and times
// how soon a result knows of each. Prints a table and ends.
#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <thread>

#include <berth_msgs/msg/link_distances.hpp>

#include "berth/pipeline/result.hpp"
#include "berth/scene/open_scene.hpp"
#include "nodes.hpp"
#include "scene_messages.hpp"

namespace berth_ros {
namespace {

std::string row_of(const std::string& name, const std::vector<double>& times_us) {
  const berth::RequestTiming timing = berth::timing_of(times_us);
  char text[160];
  std::snprintf(text, sizeof text, "| %s | %d | %.2f | %.2f | %.2f |\n", name.c_str(),
                timing.repeat, timing.p50_us / 1e3, timing.p99_us / 1e3, timing.max_us / 1e3);
  return text;
}

}  // namespace

class LatencyProbeNode : public rclcpp::Node {
 public:
  explicit LatencyProbeNode(const rclcpp::NodeOptions& options)
      : Node("latency_probe", options),
        scene_(declare_parameter<std::string>("scene")),
        messages_(*this, scene_),
        image_hz_(declare_parameter("image_rate_hz", 30.0)),
        joint_hz_(declare_parameter("joint_rate_hz", 1000.0)),
        seconds_(declare_parameter("seconds", 20.0)),
        warm_up_s_(declare_parameter("warm_up_s", 5.0)) {
    distances_ = create_subscription<berth_msgs::msg::LinkDistances>(
        "distances", rclcpp::QoS(100),
        [this](const berth_msgs::msg::LinkDistances& result) { on_distances(result); });
    begin_ = now();
    player_ = std::jthread([this](const std::stop_token& stop) { play(stop); });
  }

 private:
  double elapsed_s() { return (now() - begin_).seconds(); }

  /// The scene's joints there and back, so that nothing jumps.
  double scene_time_s(double elapsed) const {
    const double first_s = scene_.joints().first_s();
    const double length_s = scene_.joints().last_s() - first_s;
    const double at_s = std::fmod(elapsed, 2 * length_s);
    return first_s + (at_s <= length_s ? at_s : 2 * length_s - at_s);
  }

  void play(const std::stop_token& stop) {
    const std::size_t cameras = scene_.cameras();
    std::vector<double> next_image_s(cameras);
    // Not all at once.
    for (std::size_t c = 0; c < cameras; ++c) next_image_s[c] = 1 + c / (image_hz_ * cameras);
    double next_joint_s = 0;
    while (!stop.stop_requested() && elapsed_s() < warm_up_s_ + seconds_) {
      for (std::size_t c = 0; c < cameras; ++c) {
        if (elapsed_s() < next_image_s[c]) continue;
        next_image_s[c] += 1 / image_hz_;
        messages_.publish_image(c, scene_.frame_at(c, scene_time_s(elapsed_s())), now());
      }
      if (elapsed_s() >= next_joint_s) {
        next_joint_s += 1 / joint_hz_;
        scene_.joints_at(scene_time_s(elapsed_s()), joints_);
        messages_.publish_joints(joints_, now());
      }
      const double until_s =
          std::min(next_joint_s, *std::min_element(next_image_s.begin(), next_image_s.end()));
      std::this_thread::sleep_for(
          std::chrono::duration<double>(std::max(0.0, until_s - elapsed_s())));
    }
    finish();
  }

  void on_distances(const berth_msgs::msg::LinkDistances& result) {
    const rclcpp::Time heard = now();
    const std::lock_guard lock(mutex_);
    const bool counts = (heard - begin_).seconds() > warm_up_s_;
    results_ += counts;
    ok_ += counts && result.status == berth_msgs::msg::LinkDistances::OK;
    const auto take = [&](const std::string& name, const builtin_interfaces::msg::Time& stamp) {
      const rclcpp::Time at(stamp);
      rclcpp::Time& last = last_.try_emplace(name, 0, 0, at.get_clock_type()).first->second;
      if (at <= last) return;
      last = at;
      if (counts) times_us_[name].push_back((heard.nanoseconds() - at.nanoseconds()) * 1e-3);
    };
    for (const auto& camera : result.cameras) take("image of " + camera.camera, camera.stamp);
    take("joint state", result.joints_stamp);
  }

  void finish() {
    const std::lock_guard lock(mutex_);
    std::printf(
        "%.0f results a second, %.1f %% ok\n| in | new ones | median, ms | 99 %% | greatest |\n"
        "| --- | ---: | ---: | ---: | ---: |\n",
        results_ / seconds_, results_ > 0 ? 100.0 * ok_ / results_ : 0.0);
    for (const auto& [name, times_us] : times_us_)
      std::fputs(row_of(name, times_us).c_str(), stdout);
    std::fflush(stdout);
    rclcpp::shutdown();
  }

  PlayedScene scene_;
  SceneMessages messages_;
  double image_hz_;
  double joint_hz_;
  double seconds_;
  double warm_up_s_;
  berth::JointState joints_;
  std::mutex mutex_;
  std::map<std::string, rclcpp::Time> last_;
  /// What came in, and how long after it a result knew of it.
  std::map<std::string, std::vector<double>> times_us_;
  double results_ = 0;
  double ok_ = 0;
  rclcpp::Time begin_;
  rclcpp::Subscription<berth_msgs::msg::LinkDistances>::SharedPtr distances_;
  std::jthread player_;
};

std::shared_ptr<rclcpp::Node> make_latency_probe_node(const rclcpp::NodeOptions& options) {
  return std::make_shared<LatencyProbeNode>(options);
}

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::LatencyProbeNode)
