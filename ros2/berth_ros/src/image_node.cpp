#include "image_node.hpp"

namespace berth_ros {
namespace {

/// Parameters of topics, which are this node's, were given to the other one.
std::vector<rclcpp::Parameter> overrides_of(rclcpp_lifecycle::LifecycleNode& node) {
  std::vector<rclcpp::Parameter> overrides;
  for (const auto& [name, value] :
       node.get_node_parameters_interface()->get_parameter_overrides()) {
    overrides.emplace_back(name, value);
  }
  return overrides;
}

rclcpp::NodeOptions options_beside(rclcpp_lifecycle::LifecycleNode& node) {
  rclcpp::NodeOptions options;
  options.context(node.get_node_base_interface()->get_context());
  options.use_global_arguments(false);
  options.use_intra_process_comms(node.get_node_options().use_intra_process_comms());
  options.enable_rosout(false);
  options.start_parameter_services(false);
  options.start_parameter_event_publisher(false);
  options.parameter_overrides(overrides_of(node));
  return options;
}

rclcpp::ExecutorOptions executor_options(rclcpp::Node& node) {
  rclcpp::ExecutorOptions options;
  options.context = node.get_node_base_interface()->get_context();
  return options;
}

}  // namespace

ImageNode::ImageNode(rclcpp_lifecycle::LifecycleNode& beside, std::size_t threads)
    : node_(std::make_shared<rclcpp::Node>(std::string(beside.get_name()) + "_images",
                                           beside.get_namespace(), options_beside(beside))),
      executor_(executor_options(*node_), threads) {}

void ImageNode::spin() {
  executor_.add_node(node_);
  thread_ = std::thread([this] { executor_.spin(); });
}

ImageNode::~ImageNode() {
  // Asked before it spins, cancel() would go unheard.
  while (thread_.joinable() && rclcpp::ok(node_->get_node_base_interface()->get_context()) &&
         !executor_.is_spinning()) {
    std::this_thread::yield();
  }
  executor_.cancel();
  if (thread_.joinable()) thread_.join();
}

}  // namespace berth_ros
