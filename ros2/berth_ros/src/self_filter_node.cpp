// Takes the robot out of one camera's depth images.
#include <cstring>
#include <image_transport/image_transport.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <sensor_msgs/image_encodings.hpp>

#include "live_node.hpp"
#include "nodes.hpp"

namespace berth_ros {

class SelfFilterNode : public LiveNode {
 public:
  explicit SelfFilterNode(const rclcpp::NodeOptions& options)
      : LiveNode("self_filter_node", options, true) {
    begin();
  }
  ~SelfFilterNode() override { end(); }

 private:
  using Image = sensor_msgs::msg::Image;

  void configure_outputs() override {
    robot_mask_ = create_publisher<Image>("robot_mask", rclcpp::SensorDataQoS());
    robot_depth_ = create_publisher<Image>("robot_depth", rclcpp::SensorDataQoS());
  }
  void on_images() override {
    world_depth_ = image_transport::create_publisher(
        &images().node(), get_node_topics_interface()->resolve_topic_name("world_depth"),
        rclcpp::SensorDataQoS().get_rmw_qos_profile());
  }
  void clean_outputs() override {
    world_depth_ = {};
    robot_mask_.reset();
    robot_depth_.reset();
  }

  void on_frame(std::size_t, const std::shared_ptr<const berth::Frame>& observed, berth::DepthView,
                const std::shared_ptr<const Image>& image) override {
    const berth::Frame& frame = *observed;
    // Without the robot's pose nobody knows which pixels are the robot's: no image is better.
    if (frame.time.status != berth::TimeStatus::ok || !frame.watch.is_trusted()) return;
    const berth::Camera& camera = frame.mounted->camera();
    if (world_depth_.getNumSubscribers() > 0)
      world_depth_.publish(without_robot(frame, *image, camera));
    if (robot_mask_->get_subscription_count() > 0) robot_mask_->publish(mask_of(frame, *image));
    if (robot_depth_->get_subscription_count() > 0) robot_depth_->publish(robot_of(frame, *image));
  }

  std::shared_ptr<Image> without_robot(const berth::Frame& frame, const Image& image,
                                       const berth::Camera& camera) const {
    auto out = std::make_shared<Image>(image);
    berth::write_raw_obstacles(raw_of(image), camera, frame.obstacles, camera_settings().units,
                               out->data);
    return out;
  }

  static std::unique_ptr<Image> empty_like(const Image& image, const std::string& encoding,
                                           std::size_t pixel_bytes) {
    auto out = std::make_unique<Image>();
    out->header = image.header;
    out->width = image.width;
    out->height = image.height;
    out->encoding = encoding;
    out->step = static_cast<std::uint32_t>(image.width * pixel_bytes);
    out->data.resize(std::size_t{out->step} * image.height);
    return out;
  }

  /// 255 where a reading was taken for the robot, its environment, or what padding takes beside it.
  static std::unique_ptr<Image> mask_of(const berth::Frame& frame, const Image& image) {
    auto out = empty_like(image, sensor_msgs::image_encodings::MONO8, 1);
    const auto& fate = frame.obstacles.fate.pixels();
    for (std::size_t i = 0; i < fate.size(); ++i) {
      const bool kept = berth::is_kept(fate[i]) || fate[i] == berth::PixelFate::no_reading;
      out->data[i] = kept ? 0 : 255;
    }
    return out;
  }

  /// The robot as it is drawn, NaN where it is not.
  static std::unique_ptr<Image> robot_of(const berth::Frame& frame, const Image& image) {
    auto out = empty_like(image, sensor_msgs::image_encodings::TYPE_32FC1, sizeof(float));
    std::memcpy(out->data.data(), frame.robot.depth_m.pixels().data(), out->data.size());
    return out;
  }

  image_transport::Publisher world_depth_;
  rclcpp_lifecycle::LifecyclePublisher<Image>::SharedPtr robot_mask_;
  rclcpp_lifecycle::LifecyclePublisher<Image>::SharedPtr robot_depth_;
};

std::shared_ptr<rclcpp_lifecycle::LifecycleNode> make_self_filter_node(
    const rclcpp::NodeOptions& options) {
  return std::make_shared<SelfFilterNode>(options);
}

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::SelfFilterNode)
