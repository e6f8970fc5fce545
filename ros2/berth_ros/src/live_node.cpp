#include "live_node.hpp"

#include "berth/pipeline/camera_state.hpp"
#include "berth/scene/open_scene.hpp"
#include "robot_description.hpp"

namespace berth_ros {
namespace {

using diagnostic_msgs::msg::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

/// How many a second since the report before.
double rate_since(std::int64_t count, const rclcpp::Time& now, std::int64_t& before,
                  rclcpp::Time& before_at) {
  const double passed_s = before_at.nanoseconds() == 0 ? 0 : (now - before_at).seconds();
  const double rate = passed_s > 0 ? (count - before) / passed_s : 0;
  before = count;
  before_at = now;
  return rate;
}

}  // namespace

LiveNode::LiveNode(const std::string& name, const rclcpp::NodeOptions& options, bool has_one_camera)
    : Node(name, options),
      diagnostics_(this),
      settings_(*this, has_one_camera),
      tf_(get_clock()),
      joints_group_(create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive)),
      robot_group_(create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive)) {
  // Its thread of its own hears TF while callbacks of the node run.
  tf_listener_ = std::make_unique<tf2_ros::TransformListener>(tf_);
  const std::vector<CameraSettings> cameras = settings_.cameras();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    camera_names_.push_back(cameras[i].name);
    inputs_.push_back(std::make_unique<CameraInput>(
        *this, cameras[i], clock_, tf_,
        [this, i](const berth::Frame& frame,
                  const std::shared_ptr<const sensor_msgs::msg::Image>& image) {
          on_frame(i, frame, image);
        }));
  }
  reported_images_.resize(cameras.size());
  reported_images_at_.resize(cameras.size(), rclcpp::Time(0, 0, get_clock()->get_clock_type()));
  reported_joints_at_ = rclcpp::Time(0, 0, get_clock()->get_clock_type());
  diagnostics_.setHardwareID("berth");
  diagnostics_.add("robot", [this](DiagnosticStatusWrapper& status) { report_robot(status); });
  diagnostics_.add("joint states",
                   [this](DiagnosticStatusWrapper& status) { report_joints(status); });
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    diagnostics_.add("camera " + camera_names_[i],
                     [this, i](DiagnosticStatusWrapper& status) { report_camera(i, status); });
  }
}

void LiveNode::listen() {
  if (!settings_.urdf_path().empty()) {
    load_model([&] { return load_urdf_file(settings_.robot_settings()); });
    // Nobody can mend a file for a node that has read it.
    if (!live().robot) throw std::runtime_error(robot_trouble_);
  } else {
    rclcpp::SubscriptionOptions options;
    options.callback_group = robot_group_;
    // Within a process, Humble has no transient local.
    options.use_intra_process_comm = rclcpp::IntraProcessSetting::Disable;
    description_subscription_ = create_subscription<std_msgs::msg::String>(
        "robot_description", rclcpp::QoS(1).transient_local().reliable(),
        [this](const std_msgs::msg::String& text) { on_description(text); }, options);
  }
  rclcpp::SubscriptionOptions options;
  options.callback_group = joints_group_;
  joint_subscription_ = create_subscription<sensor_msgs::msg::JointState>(
      "joint_states", rclcpp::SensorDataQoS().keep_last(50),
      [this](const sensor_msgs::msg::JointState& state) { on_joint_state(state); }, options);
  // Humble has no callback after the fact. Nobody else refuses these parameters.
  parameters_ = add_on_set_parameters_callback([this](const auto& changes) {
    rcl_interfaces::msg::SetParametersResult result;
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
  description_subscription_.reset();
  joint_subscription_.reset();
  parameters_.reset();
  // First all threads, then the cameras: a frame of one asks for those of all.
  for (const auto& input : inputs_) input->use(nullptr, nullptr, {});
  inputs_.clear();
}

LiveRobot LiveNode::live() const {
  const std::lock_guard lock(mutex_);
  return live_;
}

LiveFrames LiveNode::frames(const berth::Robot& robot) const {
  LiveFrames frames;
  for (const auto& input : inputs_) frames.push_back(input->newest(&robot));
  return frames;
}

void LiveNode::load_model(const std::function<berth::RobotModel()>& load) {
  std::optional<berth::RobotModel> model;
  std::string trouble;
  try {
    model = load();
  } catch (const std::exception& error) {
    trouble = error.what();
    RCLCPP_ERROR(get_logger(), "%s", error.what());
  }
  {
    const std::lock_guard lock(mutex_);
    model_ = std::move(model);
    robot_trouble_ = trouble;
    live_.joints.reset();
  }
  rebuild();
}

void LiveNode::on_description(const std_msgs::msg::String& description) {
  if (description.data == description_) return;
  description_ = description.data;
  load_model([&] { return load_description(description_, settings_.robot_settings()); });
}

void LiveNode::rebuild() {
  LiveRobot made;
  try {
    const std::lock_guard lock(mutex_);
    if (model_) {
      const auto& scene = settings_.scene();
      made.robot = std::make_shared<const berth::Robot>(
          *model_, settings_.evaluation(),
          scene ? berth::attachments_of(*scene) : std::vector<berth::Attachment>());
      // Settings change no joints: those that came stay.
      made.joints = live_.joints
                        ? live_.joints
                        : std::make_shared<berth::JointIntake>(*model_, settings_.joint_settings());
    }
    live_ = made;
  } catch (const std::exception& error) {
    RCLCPP_ERROR(get_logger(), "%s", error.what());
    const std::lock_guard lock(mutex_);
    robot_trouble_ = error.what();
    live_ = made = {};
  }
  const std::vector<CameraSettings> cameras = settings_.cameras();
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    inputs_[i]->use(made.robot, made.joints, cameras[i].view);
  }
  on_robot();
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
    if (!trouble.empty()) ++refused_joint_messages_;
  }
  for (const auto& input : inputs_) input->joints_came();
  on_joints();
}

void LiveNode::report_robot(DiagnosticStatusWrapper& status) {
  const std::lock_guard lock(mutex_);
  if (!live_.robot) return status.summary(DiagnosticStatus::ERROR, robot_trouble_);
  status.summary(DiagnosticStatus::OK, "loaded");
  status.add("robot", live_.robot->model().name);
  status.add("links evaluated", live_.robot->model().link_count());
  status.add("joints", live_.robot->model().joints.size());
}

void LiveNode::report_joints(DiagnosticStatusWrapper& status) {
  const LiveRobot robot = live();
  const rclcpp::Time now = this->now();
  const std::lock_guard lock(mutex_);
  const double rate = rate_since(joint_messages_, now, reported_joints_, reported_joints_at_);
  status.add("messages a second", rate);
  status.add("refused", refused_joint_messages_);
  if (!robot.joints) return status.summary(DiagnosticStatus::WARN, "no robot model yet");
  const double age_s = clock_.seconds(now) - robot.joints->buffer().newest_stamp_s();
  const std::string waiting_for(robot.joints->waiting_for());
  status.add("age of the newest whole sample, s", age_s);
  status.add("clock was set back", robot.joints->restarts());
  if (!waiting_for.empty()) status.add("waiting for joint", waiting_for);
  // NaN, which is no limit's, too.
  if (!(age_s <= robot.robot->settings().time.max_joints_age_s + 1)) {
    const std::string of = waiting_for.empty() ? "" : " (waiting for joint " + waiting_for + ")";
    status.summary(DiagnosticStatus::ERROR, "no new joint states" + of);
  } else if (!joint_trouble_.empty()) {
    status.summary(DiagnosticStatus::WARN, "the newest message was refused: " + joint_trouble_);
  } else {
    status.summary(DiagnosticStatus::OK, "coming");
  }
}

void LiveNode::report_camera(std::size_t camera, DiagnosticStatusWrapper& status) {
  const CameraReport report = inputs_[camera]->report();
  const rclcpp::Time now = this->now();
  status.add("images a second", rate_since(report.counts.images, now, reported_images_[camera],
                                           reported_images_at_[camera]));
  status.add("dropped", report.counts.dropped);
  status.add("refused", report.refused);
  status.add("stale", report.counts.stale);
  status.add("waited for joints, ms", 1e3 * report.counts.last_wait_s);
  status.add("longest wait, ms", 1e3 * report.counts.longest_wait_s);
  status.add("observed in, ms", 1e3 * report.counts.last_observe_s);
  status.add("pose from", report.pose_from);
  status.add("poses so far", report.mounts);
  if (!report.trouble.empty()) return status.summary(DiagnosticStatus::ERROR, report.trouble);
  if (!report.newest) return status.summary(DiagnosticStatus::WARN, "no image observed yet");
  const berth::Frame& frame = *report.newest;
  const auto pixels = static_cast<double>(frame.obstacles.fate.pixels().size());
  for (int i = 0; pixels > 0 && i < berth::kPixelFateCount; ++i) {
    const auto fate = static_cast<berth::PixelFate>(i);
    if (frame.obstacles.count[i] == 0) continue;
    status.add("share of pixels: " + std::string(name_of(fate)), frame.obstacles.count[i] / pixels);
  }
  const LiveRobot robot = live();
  if (!robot.robot) return status.summary(DiagnosticStatus::WARN, "no robot model");
  const berth::CameraState state =
      berth::camera_state(&frame, clock_.seconds(now), robot.robot->settings().time);
  status.add("age of the newest image, s", state.age_s);
  if (state.watch.is_on) {
    status.add("seen through the robot", state.watch.seen_through);
    status.add("robot displaced by, m", state.watch.displacement_m);
  }
  if (state.watch.is_implausible) {
    status.add("share of readings at the robot's surface", state.watch.at_robot);
  }
  if (state.status == berth::CameraStatus::hidden) {
    return status.summary(DiagnosticStatus::WARN, "the robot is hidden");
  }
  if (state.status == berth::CameraStatus::unconfirmed) {
    return status.summary(DiagnosticStatus::WARN,
                          "the robot is not where it should be in the images");
  }
  if (state.status == berth::CameraStatus::ok) return status.summary(DiagnosticStatus::OK, "ok");
  const std::string_view why =
      state.status == berth::CameraStatus::stale ? name_of(state.time) : name_of(state.status);
  status.summary(DiagnosticStatus::ERROR, "not used: " + std::string(why));
}

}  // namespace berth_ros
