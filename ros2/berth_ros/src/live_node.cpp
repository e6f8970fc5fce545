#include "live_node.hpp"

#include <algorithm>
#include <chrono>
#include <lifecycle_msgs/msg/state.hpp>
#include <limits>

#include "berth/pipeline/request.hpp"
#include "robot_description.hpp"

namespace berth_ros {
namespace {

using diagnostic_updater::DiagnosticStatusWrapper;

const std::string kDisabled = "the node is disabled";
const std::string kClockStands = "the node's clock stands";

/// Often enough to see what is lost for two images.
constexpr std::chrono::milliseconds kWatchPeriod{50};

}  // namespace

LiveNode::LiveNode(const std::string& name, const rclcpp::NodeOptions& options, bool has_one_camera)
    : LifecycleNode(name, options),
      diagnostics_(this),
      has_one_camera_(has_one_camera),
      settings_(*this, has_one_camera),
      life_(make_gate()),
      gate_(make_gate()) {
  gate_->close();
  for (const CameraSettings& camera : settings_.cameras()) camera_names_.push_back(camera.name);
  diagnostics_.setHardwareID("berth");
  add_report("robot", [this](DiagnosticStatusWrapper& status) { report_robot(status); });
  add_report("joint states", [this](DiagnosticStatusWrapper& status) { report_joints(status); });
  for (std::size_t i = 0; i < camera_names_.size(); ++i) {
    add_report("camera " + camera_names_[i],
               [this, i](DiagnosticStatusWrapper& status) { report_camera(i, status); });
  }
}

std::shared_ptr<CallbackGate> LiveNode::make_gate() {
  return std::make_shared<CallbackGate>([this](const std::string& trouble) {
    const std::lock_guard lock(mutex_);
    callback_trouble_ = trouble;
  });
}

void LiveNode::add_report(const std::string& name, const diagnostic_updater::TaskFunction& report) {
  diagnostics_.add(name, [life = life_, report](DiagnosticStatusWrapper& status) {
    life->run([&] { report(status); });
  });
}

void LiveNode::begin() {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description =
      "whether the node configures and activates itself; else a lifecycle manager does";
  descriptor.read_only = true;
  const bool starts_itself = declare_parameter("autostart", true, descriptor);
  attachments_.emplace(*this, [this](const auto& make) { change_attached(make); });
  follow_moveit();
  NodeSettings::require_declared(*this, has_one_camera_);
  enable_ = create_service<std_srvs::srv::SetBool>(
      "~/set_enabled",
      [this, life = life_](const std::shared_ptr<std_srvs::srv::SetBool::Request>& request,
                           const std::shared_ptr<std_srvs::srv::SetBool::Response>& response) {
        life->run([&] {
          is_enabled_ = request->data;
          if (!is_enabled_) on_stop(kDisabled);
          response->success = true;
          response->message = request->data ? "enabled" : "disabled: no distances, and a stop";
          RCLCPP_INFO(get_logger(), "%s", response->message.c_str());
        });
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
  deactivate();
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

void LiveNode::deactivate() {
  if (is_active_.exchange(false)) deactivate_outputs();
}

void LiveNode::end() {
  deactivate();
  life_->close();
  stop();
}

void LiveNode::start() {
  const std::shared_ptr<CallbackGate> gate = make_gate();
  {
    const std::lock_guard lock(mutex_);
    gate_ = gate;
  }
  // What comes at once, as latched messages do, waits and is not lost.
  const auto hold = gate->hold();
  // Before any stamp of a message: a double holds ns best near the first one.
  clock_.seconds(now());
  configure_outputs();
  make_cameras();
  listen();
  // The last moment at which something can be said, where a signal ends the program.
  at_shutdown_ = get_node_base_interface()->get_context()->add_pre_shutdown_callback(
      [this, gate] { gate->run([this] { deactivate(); }); });
}

std::shared_ptr<CallbackGate> LiveNode::gate() const {
  const std::lock_guard lock(mutex_);
  return gate_;
}

void LiveNode::make_cameras() {
  const std::vector<CameraSettings> cameras = settings_.cameras();
  const rclcpp::Time never(0, 0, get_clock()->get_clock_type());
  reported_images_.assign(cameras.size(), {});
  reported_images_at_.assign(cameras.size(), never);
  {
    const std::lock_guard lock(mutex_);
    reported_joints_at_ = never;
    robot_trouble_ = "no robot_description yet";
    joint_trouble_ = "no joint state yet";
  }
  log_.emplace(get_logger(), StatusLog::now_s());
  transforms_.emplace(
      *this, gate(), [this] { look_again(); },
      [this](const std::string& frame) { begin_anew("transforms of " + frame + " went back"); });
  make_explanations(cameras);
  images_ = std::make_unique<ImageNode>(*this, std::max<std::size_t>(2, cameras.size()));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    inputs_.push_back(std::make_unique<CameraInput>(
        *this, gate(), images_->node(), cameras[i], settings_.world_frame(), clock_, *transforms_,
        [this, i](const std::shared_ptr<const berth::Frame>& frame, berth::DepthView depth_m,
                  const std::shared_ptr<const sensor_msgs::msg::Image>& image) {
          explanations_->put(i, *frame, image);
          if (is_active_ && is_enabled_) on_frame(i, frame, depth_m, image);
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
    make_for({})();
    rclcpp::SubscriptionOptions options;
    options.callback_group = robot_group_;
    // Within a process, Humble has no transient local.
    options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
    description_subscription_ = create_subscription<std_msgs::msg::String>(
        "robot_description", rclcpp::QoS(1).transient_local().reliable(),
        [this, gate](const std_msgs::msg::String& text) {
          gate->run([&] { on_description(text); });
        },
        options);
  }
  rclcpp::SubscriptionOptions options;
  options.callback_group = joints_group_;
  options.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies();
  joint_subscription_ = create_subscription<sensor_msgs::msg::JointState>(
      "joint_states", rclcpp::SensorDataQoS().keep_last(50),
      [this, gate](const sensor_msgs::msg::JointState& state) {
        gate->run([&] { on_joint_state(state); });
      },
      options);
  take_parameters();
  watch_timer_ = create_wall_timer(
      kWatchPeriod, [this, gate] { gate->run([this] { watch(); }); }, watch_group_);
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
    const GivenParameters before = settings_.given();
    try {
      settings_.check(changes);
      if (settings_.take(changes) && model_) use(make_robot(attached_.all()));
      result.successful = true;
    } catch (const std::exception& error) {
      settings_.put_back(before);
      result.reason = error.what();
    }
    return result;
  });
}

void LiveNode::stop() {
  if (at_shutdown_) {
    get_node_base_interface()->get_context()->remove_pre_shutdown_callback(*at_shutdown_);
    at_shutdown_.reset();
  }
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

std::string LiveNode::why_silent(const LiveRobot& robot) const {
  if (!is_active_) return "the node is not active";
  if (!is_enabled_) return kDisabled;
  if (!robot.robot) return "there is no robot model";
  if (clock_watch_.stands()) return kClockStands;
  return robot.beginnings == beginnings_ ? "" : "all begins anew";
}

void LiveNode::look_at_clock() {
  const double back_s = clock_watch_.look(*get_clock());
  if (back_s > 0) begin_anew("the clock was set back by " + std::to_string(back_s) + " s");
}

void LiveNode::begin_anew(const std::string& why) {
  ++beginnings_;
  on_stop(why);
  RCLCPP_WARN(get_logger(), "%s: beginning anew", why.c_str());
  const std::lock_guard making(making_mutex_);
  transforms_->forget();
  LiveRobot made = live();
  if (!made.robot) return;
  made.joints = std::make_shared<berth::JointIntake>(*model_, settings_.joint_settings());
  made.beginnings = beginnings_;
  use(made);
}

void LiveNode::on_joint_state(const sensor_msgs::msg::JointState& state) {
  look_at_clock();
  double stamp_s = std::numeric_limits<double>::quiet_NaN();
  const LiveRobot now = live();
  if (!now.joints) return on_joints(stamp_s, state);
  std::string trouble;
  try {
    stamp_s = clock_.seconds(state.header.stamp);
    const double ahead_s = stamp_s - clock_.seconds(this->now());
    if (ahead_s > berth::kMostJointsAhead_s) {
      throw std::invalid_argument("stamp: " + std::to_string(ahead_s) +
                                  " s after the node's clock; expected one before it");
    }
    const berth::TimeStatus status = now.joints->push(stamp_s, state.name, state.position);
    if (status != berth::TimeStatus::ok) trouble = std::string(name_of(status));
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  if (now.joints->restarts() > 0) return begin_anew("joint states went back in time");
  {
    const std::lock_guard lock(mutex_);
    ++joint_messages_;
    joint_trouble_ = trouble;
    rhythm_.add(now.joints->buffer().newest_stamp_s());
    if (!trouble.empty()) ++refused_joint_messages_;
  }
  look_again();
  on_joints(stamp_s, state);
}

}  // namespace berth_ros
