#include "live_node.hpp"

#include <algorithm>
#include <chrono>
#include <lifecycle_msgs/msg/state.hpp>

#include "robot_description.hpp"

namespace berth_ros {
namespace {

using diagnostic_updater::DiagnosticStatusWrapper;

/// Often enough to see what is lost for two images.
constexpr std::chrono::milliseconds kWatchPeriod{50};

}  // namespace

LiveNode::LiveNode(const std::string& name, const rclcpp::NodeOptions& options, bool has_one_camera)
    : LifecycleNode(name, options),
      diagnostics_(this),
      has_one_camera_(has_one_camera),
      settings_(*this, has_one_camera),
      gate_(std::make_shared<CallbackGate>()) {
  gate_->close();
  for (const CameraSettings& camera : settings_.cameras()) camera_names_.push_back(camera.name);
  diagnostics_.setHardwareID("berth");
  diagnostics_.add("robot", [this](DiagnosticStatusWrapper& status) { report_robot(status); });
  diagnostics_.add("joint states",
                   [this](DiagnosticStatusWrapper& status) { report_joints(status); });
  for (std::size_t i = 0; i < camera_names_.size(); ++i) {
    diagnostics_.add("camera " + camera_names_[i],
                     [this, i](DiagnosticStatusWrapper& status) { report_camera(i, status); });
  }
}

void LiveNode::begin() {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description =
      "whether the node configures and activates itself; else a lifecycle manager does";
  descriptor.read_only = true;
  const bool starts_itself = declare_parameter("autostart", true, descriptor);
  const ChangeAttached change = [this](const auto& make) { change_attached(make); };
  attachments_.emplace(*this, change);
  attach_actions_.emplace(*this, change, [this] { return cameras_waited_for(); });
  follow_moveit();
  NodeSettings::require_declared(*this, has_one_camera_);
  enable_ = create_service<std_srvs::srv::SetBool>(
      "~/set_enabled", [this](const std::shared_ptr<std_srvs::srv::SetBool::Request>& request,
                              const std::shared_ptr<std_srvs::srv::SetBool::Response>& response) {
        is_enabled_ = request->data;
        response->success = true;
        response->message = request->data ? "enabled" : "disabled: no distances, and a stop";
        RCLCPP_INFO(get_logger(), "%s", response->message.c_str());
      });
  if (!starts_itself) return;
  const bool is_configured = configure().id() == lifecycle_msgs::msg::State::PRIMARY_STATE_INACTIVE;
  if (!is_configured) throw std::runtime_error(robot_trouble_);
  activate();
}

void LiveNode::follow_moveit() {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description =
      "whether what MoveIt has attached to the robot (monitored_planning_scene) is the robot's";
  descriptor.read_only = true;
  if (!declare_parameter("follow_moveit", false, descriptor)) return;
#ifdef BERTH_ROS_MOVEIT
  moveit_.emplace(*this, [this](const auto& change) { change_attached(change); });
#else
  throw std::invalid_argument(
      "follow_moveit: true; expected false, since moveit_msgs was not installed where berth_ros "
      "was built");
#endif
}

LiveNode::CallbackReturn LiveNode::on_configure(const State&) {
  try {
    start();
    return CallbackReturn::SUCCESS;
  } catch (const std::exception& error) {
    {
      const std::lock_guard lock(mutex_);
      robot_trouble_ = error.what();
    }
    RCLCPP_ERROR(get_logger(), "%s", error.what());
    stop();
    clean_outputs();
    return CallbackReturn::FAILURE;
  }
}

LiveNode::CallbackReturn LiveNode::on_activate(const State& before) {
  LifecycleNode::on_activate(before);
  is_active_ = true;
  activate_outputs();
  return CallbackReturn::SUCCESS;
}

LiveNode::CallbackReturn LiveNode::on_deactivate(const State& before) {
  is_active_ = false;
  deactivate_outputs();
  LifecycleNode::on_deactivate(before);
  return CallbackReturn::SUCCESS;
}

LiveNode::CallbackReturn LiveNode::on_cleanup(const State&) {
  stop();
  clean_outputs();
  return CallbackReturn::SUCCESS;
}

LiveNode::CallbackReturn LiveNode::on_shutdown(const State& before) {
  if (is_active_) on_deactivate(before);
  return on_cleanup(before);
}

void LiveNode::start() {
  const auto gate = std::make_shared<CallbackGate>();
  {
    const std::lock_guard lock(mutex_);
    gate_ = gate;
  }
  // What comes at once, as latched messages do, waits and is not lost.
  const auto hold = gate->hold();
  configure_outputs();
  make_cameras();
  listen();
}

std::shared_ptr<CallbackGate> LiveNode::gate() const {
  const std::lock_guard lock(mutex_);
  return gate_;
}

void LiveNode::make_cameras() {
  const std::vector<CameraSettings> cameras = settings_.cameras();
  const rclcpp::Time never(0, 0, get_clock()->get_clock_type());
  reported_images_.assign(cameras.size(), 0);
  reported_images_at_.assign(cameras.size(), never);
  {
    const std::lock_guard lock(mutex_);
    reported_joints_at_ = never;
    robot_trouble_ = "no robot_description yet";
    joint_trouble_ = "no joint state yet";
  }
  log_.emplace(get_logger(), StatusLog::now_s());
  transforms_.emplace(*this, gate(), [this] { look_again(); });
  make_explanations(cameras);
  images_ = std::make_unique<ImageNode>(*this, std::max<std::size_t>(2, cameras.size()));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    inputs_.push_back(std::make_unique<CameraInput>(
        *this, gate(), images_->node(), cameras[i], settings_.world_frame(), clock_, *transforms_,
        [this, i](const std::shared_ptr<const berth::Frame>& frame, berth::DepthView depth_m,
                  const std::shared_ptr<const sensor_msgs::msg::Image>& image) {
          explanations_->put(i, *frame, image);
          if (is_answering()) on_frame(i, frame, depth_m, image);
        }));
  }
}

void LiveNode::make_explanations(const std::vector<CameraSettings>& cameras) {
  explanations_ = std::make_unique<CameraExplanations>(
      cameras, [this] { return live().joints; },
      [this](std::size_t camera, const CameraExplanation& told) {
        if (!told.is_sure) return;
        inputs_[camera]->distrust(told.text.empty() ? std::nullopt
                                                    : std::optional(told.mounted->mount()));
      });
}

void LiveNode::listen() {
  const std::shared_ptr<CallbackGate> gate = this->gate();
  joints_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  robot_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  watch_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  if (!settings_.urdf_path().empty()) {
    load_model([&] { return load_urdf_file(settings_.robot_settings()); });
    // Nobody can fix a file for a node that has read it.
    if (!live().robot) throw std::runtime_error(robot_trouble_);
  } else {
    on_robot();
    rclcpp::SubscriptionOptions options;
    options.callback_group = robot_group_;
    // Within a process, Humble has no transient local.
    options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
    description_subscription_ = create_subscription<std_msgs::msg::String>(
        "robot_description", rclcpp::QoS(1).transient_local().reliable(),
        [this, gate](const std_msgs::msg::String& text) {
          if (const auto pass = gate->enter()) on_description(text);
        },
        options);
  }
  rclcpp::SubscriptionOptions options;
  options.callback_group = joints_group_;
  options.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();
  joint_subscription_ = create_subscription<sensor_msgs::msg::JointState>(
      "joint_states", rclcpp::SensorDataQoS().keep_last(50),
      [this, gate](const sensor_msgs::msg::JointState& state) {
        if (const auto pass = gate->enter()) on_joint_state(state);
      },
      options);
  take_parameters();
  watch_timer_ = create_wall_timer(
      kWatchPeriod,
      [this, gate] {
        if (const auto pass = gate->enter()) watch();
      },
      watch_group_);
  on_images();
  images_->spin();
}

void LiveNode::take_parameters() {
  // Humble has no callback after the fact. Nobody else refuses these parameters.
  parameters_ = add_on_set_parameters_callback([this, gate = gate()](const auto& changes) {
    rcl_interfaces::msg::SetParametersResult result;
    const auto pass = gate->enter();
    // As without this callback, which is gone.
    if (!pass) {
      result.successful = true;
      return result;
    }
    const std::lock_guard making(making_mutex_);
    try {
      settings_.check(changes);
      result.successful = true;
      if (settings_.take(changes)) rebuild();
    } catch (const std::exception& error) {
      result.reason = error.what();
    }
    return result;
  });
}

void LiveNode::stop() {
  watch_timer_.reset();
  description_subscription_.reset();
  joint_subscription_.reset();
  parameters_.reset();
  // Callbacks that have begun use what is below.
  gate()->close();
  // First no image comes any more, then all threads end, then the cameras: a frame of one asks for
  // those of all.
  images_.reset();
  for (const auto& input : inputs_) input->use(nullptr, nullptr, {});
  explanations_.reset();
  inputs_.clear();
  transforms_.reset();
  const std::lock_guard making(making_mutex_);
  const std::lock_guard lock(mutex_);
  model_.reset();
  description_.clear();
  live_ = {};
}

LiveRobot LiveNode::live() const {
  const std::lock_guard lock(mutex_);
  return live_;
}

double LiveNode::longest_joint_gap_s() const {
  const std::lock_guard lock(mutex_);
  return rhythm_.longest_gap_s();
}

LiveFrames LiveNode::frames(const berth::Robot& robot) const {
  LiveFrames frames;
  for (const auto& input : inputs_) frames.push_back(input->newest(&robot));
  return frames;
}

std::optional<berth::Pose> LiveNode::root_at(const berth::Robot& robot, double stamp_s) {
  if (settings_.world_frame().empty()) return std::nullopt;
  const std::string& world = settings_.world_frame();
  const std::string& root = robot.model().links.front().name;
  const double max_age_s = robot.settings().time.max_joints_age_s;
  const rclcpp::Time stamp(clock_.stamp(stamp_s), RCL_ROS_TIME);
  std::string why;
  auto told = transforms_->at(world, root, stamp, max_age_s, why);
  if (!told) {
    // As joints are, where it is when it was told last.
    told = transforms_->newest(world, root, why);
    const bool is_old = told && !told->is_static && (stamp - told->stamp).seconds() > max_age_s;
    if (is_old) told.reset();
  }
  return told ? told->X_PF : berth::unset_pose();
}

void LiveNode::look_again() {
  for (const auto& input : inputs_) input->look_again();
}

void LiveNode::on_joint_state(const sensor_msgs::msg::JointState& state) {
  const LiveRobot now = live();
  if (!now.joints) return;
  std::string trouble;
  try {
    const int restarts = now.joints->restarts();
    const berth::TimeStatus status =
        now.joints->push(clock_.seconds(state.header.stamp), state.name, state.position);
    if (status != berth::TimeStatus::ok) trouble = std::string(name_of(status));
    if (now.joints->restarts() != restarts) {
      RCLCPP_WARN(get_logger(), "joint states went back in time: beginning anew");
    }
  } catch (const std::invalid_argument& error) {
    trouble = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    ++joint_messages_;
    joint_trouble_ = trouble;
    rhythm_.add(now.joints->buffer().newest_stamp_s());
    if (!trouble.empty()) ++refused_joint_messages_;
  }
  look_again();
  on_joints(state);
}

}  // namespace berth_ros
