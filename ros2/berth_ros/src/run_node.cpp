// One node as a program: BERTH_ROS_MAKE_NODE says which. What is wrong with a file or a parameter
// is a message and exit code 1.
#include <cstdio>

#include "nodes.hpp"

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    rclcpp::executors::MultiThreadedExecutor executor;
    const auto node = berth_ros::BERTH_ROS_MAKE_NODE(rclcpp::NodeOptions());
    executor.add_node(node->get_node_base_interface());
    executor.spin();
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
