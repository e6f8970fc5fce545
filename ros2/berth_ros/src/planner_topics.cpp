#include "planner_topics.hpp"

#include <algorithm>
#include <stdexcept>

#include "berth/pipeline/mounted_camera.hpp"
#include "planner_messages.hpp"

#ifdef BERTH_ROS_OCTOMAP
#include "planner_octomap.hpp"
#endif
#ifdef BERTH_ROS_MOVEIT
#include <moveit_msgs/msg/planning_scene.hpp>
#endif

namespace berth_ros {
namespace {

using Header = std_msgs::msg::Header;

rcl_interfaces::msg::ParameterDescriptor described(const std::string& text) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = true;
  return descriptor;
}

double declare_rate(rclcpp_lifecycle::LifecycleNode& node, const std::string& name,
                    const std::string& what) {
  rcl_interfaces::msg::ParameterDescriptor descriptor =
      described(what + ", times a second; 0: never");
  descriptor.floating_point_range.resize(1);
  descriptor.floating_point_range[0].to_value = 30;
  return node.declare_parameter(name + "_rate_hz", 0.0, descriptor);
}

std::vector<double> declare_numbers(rclcpp_lifecycle::LifecycleNode& node, const std::string& name,
                                    const std::vector<double>& numbers, const std::string& what) {
  const std::vector<double> given = node.declare_parameter(name, numbers, described(what));
  if (given.size() == numbers.size()) return given;
  throw std::invalid_argument(name + ": " + std::to_string(given.size()) + " numbers; expected " +
                              std::to_string(numbers.size()));
}

}  // namespace

struct PlannerTopics::Topic {
  double rate_hz = 0;
  std::function<void()> configure;
  std::function<bool()> is_wanted;
  std::function<void(const berth::VoxelGrid&, const Header&)> publish;
  std::function<void()> clean;
  rclcpp::TimerBase::SharedPtr timer;
};

template <class Message, class Make>
void PlannerTopics::offer(const std::string& name, const std::string& what, Make make) {
  auto topic = std::make_unique<Topic>();
  topic->rate_hz = declare_rate(node_, name, what);
  using Publisher = typename rclcpp_lifecycle::LifecyclePublisher<Message>::SharedPtr;
  auto publisher = std::make_shared<Publisher>();
  topic->configure = [this, publisher, name] {
    *publisher = node_.create_publisher<Message>(name, rclcpp::QoS(1));
  };
  topic->is_wanted = [publisher] { return (*publisher)->get_subscription_count() > 0; };
  topic->publish = [publisher, make](const berth::VoxelGrid& grid, const Header& header) {
    (*publisher)->publish(std::make_unique<Message>(make(grid, header)));
  };
  topic->clean = [publisher] { publisher->reset(); };
  topics_.push_back(std::move(topic));
}

PlannerTopics::PlannerTopics(rclcpp_lifecycle::LifecycleNode& node, const StampClock& clock,
                             Look look)
    : node_(node), clock_(clock), look_(std::move(look)) {
  edge_m_ = node.declare_parameter("planner.edge_m", 0.04,
                                   described("the edge of a voxel of the topics for planners"));
  const std::string in_root = ", in the robot's root link: x, y, z in metres";
  const std::vector<double> low = declare_numbers(node, "planner.box_min_m", {-1.2, -1.2, -0.5},
                                                  "least corner of the voxels" + in_root);
  const std::vector<double> high = declare_numbers(node, "planner.box_max_m", {1.2, 1.2, 1.8},
                                                   "greatest corner of the voxels" + in_root);
  box_B_m_ = {Eigen::Vector3d(low.data()), Eigen::Vector3d(high.data())};
  berth::VoxelGrid grid;
  try {
    berth::lay_voxels(box_B_m_, edge_m_, grid);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(
        std::string("planner.edge_m, planner.box_min_m, planner.box_max_m: ") + error.what());
  }
  const std::vector<double> heights =
      declare_numbers(node, "planner.occupancy_heights_m", {0.1, 1.8},
                      "the heights above the robot's root link between which `occupancy` looks");
  heights_m_ = {heights[0], heights[1]};
  if (!(heights[0] < heights[1])) {
    throw std::invalid_argument(
        "planner.occupancy_heights_m: expected the lower one before the higher one");
  }
  hidden_is_occupied_ = node.declare_parameter(
      "planner.hidden_is_occupied", false,
      described("whether what is hidden is occupied in `octomap` and `planning_scene`"));
  using berth::Voxel;
  offer<sensor_msgs::msg::PointCloud2>(
      "occupied_points", "where cameras see something that is not the robot, as points",
      [](const berth::VoxelGrid& voxels, const Header& header) {
        return points_of(voxels, Voxel::occupied, header);
      });
  offer<sensor_msgs::msg::PointCloud2>(
      "unknown_points", "what is behind what cameras see, and seen free by nobody, as points",
      [](const berth::VoxelGrid& voxels, const Header& header) {
        return points_of(voxels, Voxel::hidden, header);
      });
  offer<nav_msgs::msg::OccupancyGrid>(
      "occupancy", "the ground plan between planner.occupancy_heights_m",
      [this](const berth::VoxelGrid& voxels, const Header& header) {
        return occupancy_of(voxels, heights_m_.first, heights_m_.second, header);
      });
  offer_octomaps();
}

PlannerTopics::~PlannerTopics() = default;

void PlannerTopics::offer_octomaps() {
#ifdef BERTH_ROS_OCTOMAP
  const auto octomap = [this](const berth::VoxelGrid& voxels, const Header& header) {
    return octomap_of(voxels, hidden_is_occupied_, header);
  };
  offer<octomap_msgs::msg::Octomap>("octomap", "occupied and free space as an octree", octomap);
#ifdef BERTH_ROS_MOVEIT
  offer<moveit_msgs::msg::PlanningScene>(
      "planning_scene", "occupied and free space as a change of MoveIt's planning scene",
      [octomap](const berth::VoxelGrid& voxels, const Header& header) {
        // A change with an octomap replaces the one before: what became free is cleared.
        moveit_msgs::msg::PlanningScene scene;
        scene.is_diff = true;
        scene.robot_state.is_diff = true;
        scene.world.octomap.header = header;
        scene.world.octomap.origin.orientation.w = 1;
        scene.world.octomap.octomap = octomap(voxels, header);
        return scene;
      });
#else
  refuse("planning_scene", "moveit_msgs");
#endif
#else
  refuse("octomap", "octomap_msgs");
  refuse("planning_scene", "octomap_msgs");
#endif
}

void PlannerTopics::refuse(const std::string& name, const std::string& package) {
  const double rate_hz = declare_rate(node_, name, "not in this build, without " + package);
  if (rate_hz == 0) return;
  throw std::invalid_argument(name + "_rate_hz: " + std::to_string(rate_hz) +
                              "; expected 0, since " + package +
                              " was not installed where berth_ros was built");
}

void PlannerTopics::configure(std::shared_ptr<CallbackGate> gate) {
  gate_ = std::move(gate);
  group_ = node_.create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  log_.emplace(node_.get_logger(), StatusLog::now_s());
  for (const auto& topic : topics_) {
    if (topic->rate_hz > 0) topic->configure();
  }
}

void PlannerTopics::activate() {
  for (const auto& topic : topics_) {
    if (topic->rate_hz <= 0) continue;
    topic->timer = node_.create_wall_timer(
        std::chrono::duration<double>(1 / topic->rate_hz),
        [this, gate = gate_, t = topic.get()] { gate->run([&] { publish(*t); }); }, group_);
  }
}

void PlannerTopics::deactivate() {
  for (const auto& topic : topics_) topic->timer.reset();
}

void PlannerTopics::clean() {
  for (const auto& topic : topics_) topic->clean();
}

bool PlannerTopics::is_on() const {
  return std::ranges::any_of(topics_, [](const auto& topic) { return topic->rate_hz > 0; });
}

std::string PlannerTopics::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void PlannerTopics::publish(const Topic& topic) {
  if (!topic.is_wanted()) return;
  const std::optional<SpaceNow> now = look_();
  const std::string lost = trouble(now);
  log_->tell("topics for planners", lost, StatusLog::now_s());
  {
    const std::lock_guard lock(mutex_);
    lost_ = lost;
  }
  if (!lost.empty()) return;
  const berth::VoxelGrid& grid =
      map_.update({now->frames, now->now_s, {}, box_B_m_, edge_m_}, now->robot->settings().time);
  const std::optional<double> stamp_s = map_.newest_stamp_s();
  if (!stamp_s) return;
  Header header;
  header.frame_id = now->robot->model().links.front().name;
  header.stamp = clock_.stamp(*stamp_s);
  topic.publish(grid, header);
}

std::string PlannerTopics::trouble(const std::optional<SpaceNow>& now) {
  if (!now) return "there is no robot model, or the node is not to answer";
  for (const auto& frame : now->frames) {
    if (!frame) return "a camera has no image yet";
    const berth::CameraState state =
        berth::camera_state(frame.get(), now->now_s, now->robot->settings().time);
    if (berth::is_used(state.status) && state.status != berth::CameraStatus::blind) continue;
    return "camera " + frame->mounted->mount().name + " is " + std::string(name_of(state.status));
  }
  return "";
}

}  // namespace berth_ros
