// Plays a scene in real time, as a robot and its cameras would: images, camera_info, joint states,
// robot_description, and the cameras' poses as static transforms.
#include <algorithm>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>

#include "nodes.hpp"
#include "scene_messages.hpp"

namespace berth_ros {
namespace {

/// From one round to the next, so that no stamp comes twice.
constexpr double kBetweenRounds_s = 0.1;

}  // namespace

class ScenePlayerNode : public rclcpp::Node {
 public:
  explicit ScenePlayerNode(const rclcpp::NodeOptions& options)
      : Node("scene_player_node", options),
        scene_(declare_parameter<std::string>("scene")),
        messages_(*this, scene_) {
    declare_parameter("loop", true);
    plan();
    start_ = now() + rclcpp::Duration::from_seconds(declare_parameter("start_after_s", 1.0));
    timer_ = create_wall_timer(std::chrono::milliseconds(1), [this] { play(); });
  }

 private:
  /// A joint sample or an image that is published at a time.
  struct Event {
    double time_s;
    int camera;  // -1: a joint sample
    std::size_t index;
  };

  void plan() {
    const berth::OpenScene& scene = scene_.scene();
    for (std::size_t i = 0; i < scene.joints->size(); ++i) {
      events_.push_back({scene.joints->sample(i).stamp_s, -1, i});
    }
    for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
      for (std::size_t i = 0; i < scene.cameras[c].at_exposure.size(); ++i) {
        events_.push_back({scene.cameras[c].at_exposure[i].stamp_s, static_cast<int>(c), i});
      }
    }
    std::stable_sort(events_.begin(), events_.end(),
                     [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
  }

  void play() {
    while (true) {
      if (next_ == events_.size()) {
        if (!get_parameter("loop").as_bool()) return;
        start_ += rclcpp::Duration::from_seconds(events_.back().time_s + kBetweenRounds_s);
        next_ = 0;
      }
      const Event& event = events_[next_];
      const rclcpp::Time stamp = start_ + rclcpp::Duration::from_seconds(event.time_s);
      if (stamp > now()) return;
      publish(event, stamp);
      ++next_;
    }
  }

  void publish(const Event& event, const rclcpp::Time& stamp) {
    if (event.camera < 0) {
      messages_.publish_joints(scene_.joints().sample(event.index), stamp);
    } else {
      messages_.publish_image(event.camera, event.index, stamp);
    }
  }

  PlayedScene scene_;
  SceneMessages messages_;
  std::vector<Event> events_;
  std::size_t next_ = 0;
  rclcpp::Time start_;
  rclcpp::TimerBase::SharedPtr timer_;
};

std::shared_ptr<rclcpp::Node> make_scene_player_node(const rclcpp::NodeOptions& options) {
  return std::make_shared<ScenePlayerNode>(options);
}

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::ScenePlayerNode)
