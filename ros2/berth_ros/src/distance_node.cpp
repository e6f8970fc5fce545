// Distances of a running robot: cameras and joint states in, berth_msgs/LinkDistances out.
#include <atomic>
#include <berth_msgs/msg/link_distances.hpp>
#include <chrono>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_srvs/srv/trigger.hpp>
#include <visualization_msgs/msg/marker_array.hpp>

#include "answer_topics.hpp"
#include "berth/live/live_space.hpp"
#include "berth/record/monitor_loop.hpp"
#include "berth/results/result_text.hpp"
#include "black_box.hpp"
#include "configuration_answers.hpp"
#include "exposure_answers.hpp"
#include "live_node.hpp"
#include "markers.hpp"
#include "nodes.hpp"
#include "planner_topics.hpp"
#include "question_times.hpp"
#include "result_messages.hpp"
#include "row_messages.hpp"
#include "speed_monitor.hpp"
#include "velocity_commands.hpp"

namespace berth_ros {
namespace {

/// Shorter than AnswerTopics::kDeadline by more than a watch's period.
constexpr double kMostSilence_s = 0.08;
constexpr double kWatchPeriod_s = 0.01;

rcl_interfaces::msg::ParameterDescriptor rate(const std::string& text, double most) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = true;
  descriptor.floating_point_range.resize(1);
  descriptor.floating_point_range[0].to_value = most;
  return descriptor;
}

rcl_interfaces::msg::ParameterDescriptor described(const std::string& text) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = true;
  return descriptor;
}

/// The settings are those of a filter after each question.
void require_period(const berth::VelocityFilterSettings& settings, double question_hz) {
  if (question_hz == 0 || settings.period_s * question_hz > 0.999) return;
  throw std::invalid_argument("filter.period_s: " + std::to_string(settings.period_s) +
                              "; expected at least the time between two questions, " +
                              std::to_string(1 / question_hz) + " s (question_rate_hz)");
}

/// What the cameras of one robot leave of space, made ready as images come.
struct RobotSpace {
  RobotSpace(const LiveRobot& of, std::size_t cameras)
      : robot(of), live(robot.robot, cameras, *robot.joints) {}

  LiveRobot robot;
  berth::LiveSpace live;
};

/// Not so where a camera is another one than that of its frame, or elsewhere.
bool is_still(const berth::PreparedSpace& space, const LiveFrames& now) {
  for (std::size_t k = 0; k < now.size(); ++k) {
    const auto& frame = space.frames()[k];
    if (frame && (!now[k] || now[k]->mounted != frame->mounted)) return false;
  }
  return true;
}

}  // namespace

class DistanceNode : public LiveNode {
 public:
  explicit DistanceNode(const rclcpp::NodeOptions& options)
      : LiveNode("distance_node", options, false) {
    add_report("questions", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      report_questions(status);
    });
    question_hz_ = declare_parameter("question_rate_hz", 100.0,
                                     rate("questions a second; 0: one for each joint state. With "
                                          "a monitor or a filter never less than 12.5",
                                          1000));
    marker_hz_ = declare_parameter("marker_rate_hz", 10.0, rate("markers a second; 0: none", 100));
    velocity_window_s_ = declare_parameter(
        "velocity_window_s", 0.02,
        described("over how long a time of joint states velocities are measured, where no "
                  "planned_joint_states come"));
    declare_recording();
    planners_.emplace(*this, clock_, [this] { return space_now(); });
    if (planners_->is_on()) {
      add_report("topics for planners",
                 [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
                   const std::string lost = planners_->lost();
                   using diagnostic_msgs::msg::DiagnosticStatus;
                   if (lost.empty()) return status.summary(DiagnosticStatus::OK, "published");
                   status.summary(DiagnosticStatus::ERROR, "the map before is kept: " + lost);
                 });
    }
    offer_configurations();
    filter_velocities();
    begin();
  }
  /// Cameras' threads and callbacks use what is below.
  ~DistanceNode() override { end(); }

 private:
  using LinkDistances = berth_msgs::msg::LinkDistances;
  using Trigger = std_srvs::srv::Trigger;
  using CheckConfigurations = berth_msgs::srv::CheckConfigurations;

  void declare_recording() {
    berth::RecorderSettings settings;
    settings.file = declare_parameter(
        "record.file", "",
        described("an MCAP file for what the monitor saw and said before it stopped the "
                  "robot, for `berth replay`; the next ones are FILE_2.mcap and so on; "
                  "empty: nothing is recorded"));
    settings.seconds = declare_parameter("record.seconds", settings.seconds,
                                         described("how many of the last seconds a recording has"));
    black_box_.emplace(settings, [logger = get_logger()](const std::string& sentence) {
      RCLCPP_WARN(logger, "%s", sentence.c_str());
    });
    if (settings.file.empty()) return;
    write_recording_ = create_service<Trigger>(
        "~/record", [this](const std::shared_ptr<Trigger::Request>&,
                           const std::shared_ptr<Trigger::Response>& response) {
          const std::lock_guard lock(query_mutex_);
          response->success = black_box_->write();
          response->message = response->success ? "the log tells the file once it is written"
                                                : "no image was recorded yet";
        });
  }

  /// In a group of its own: a request may take seconds, and nobody waits for it.
  void offer_configurations() {
    check_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    // By this function, since Humble's node takes another QoS than Jazzy's.
    check_configurations_ = rclcpp::create_service<CheckConfigurations>(
        get_node_base_interface(), get_node_services_interface(), "~/check_configurations",
        [this, life = life()](const CheckConfigurations::Request::SharedPtr& request,
                              const CheckConfigurations::Response::SharedPtr& response) {
          life->run([&] { configurations_.answer(*request, *response); });
        },
        rmw_qos_profile_services_default, check_group_);
  }

  void filter_velocities() {
    if (!settings().filter()) return;
    require_period(*settings().filter(), question_hz_);
    commands_.emplace(settings().filtered_joints());
    add_report("velocity filter", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      commands_->report(status);
    });
  }

  void configure_outputs() override {
    answers_.configure();
    at_exposure_ = create_publisher<LinkDistances>("distances_at_exposure", 10);
    markers_ = create_publisher<visualization_msgs::msg::MarkerArray>("markers", 10);
    group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    watchdog_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    rclcpp::SubscriptionOptions with_group;
    with_group.callback_group = group_;
    planned_subscription_ = create_subscription<sensor_msgs::msg::JointState>(
        "planned_joint_states", rclcpp::SensorDataQoS().keep_last(1),
        [this, gate = gate()](const sensor_msgs::msg::JointState& message) {
          gate->run([&] { on_plan(message); });
        },
        with_group);
    if (commands_) {
      // It is not to wait for a question, and neither for the making of a robot.
      wanted_group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
      with_group.callback_group = wanted_group_;
      wanted_subscription_ = create_subscription<VelocityCommands::Message>(
          "wanted_velocity", rclcpp::SensorDataQoS().keep_last(1),
          [this, gate = gate()](const VelocityCommands::Message& message) {
            gate->run([&] { commands_->take(message); });
          },
          with_group);
    }
    planners_->configure(gate());
  }
  void activate_outputs() override {
    answers_.begin();
    if (question_hz_ > 0) question_timer_ = timer(1 / question_hz_, group_, [this] { ask(); });
    watchdog_ = timer(kWatchPeriod_s, watchdog_group_, [this] { end_silence(); });
    if (marker_hz_ > 0) marker_timer_ = timer(1 / marker_hz_, group_, [this] { show(); });
    planners_->activate();
  }
  void deactivate_outputs() override {
    question_timer_.reset();
    watchdog_.reset();
    marker_timer_.reset();
    planners_->deactivate();
    stop_commands("the node is not active");
    answers_.end("the node is not active", separation_settings().has_value());
  }
  void clean_outputs() override {
    planners_->clean();
    planned_subscription_.reset();
    wanted_subscription_.reset();
    planned_ = {};
    keep_space(nullptr);
    black_box_->use(nullptr, {}, 0);
    answers_.clean();
    at_exposure_.reset();
    markers_.reset();
  }

  /// By the steady clock: no clock that is set back, or stands, silences the node.
  template <class Call>
  rclcpp::TimerBase::SharedPtr timer(double period_s, const rclcpp::CallbackGroup::SharedPtr& group,
                                     Call call) {
    return create_wall_timer(
        std::chrono::duration<double>(period_s), [gate = gate(), call] { gate->run(call); }, group);
  }

  void on_joints(double stamp_s, const sensor_msgs::msg::JointState& state) override {
    if (std::isfinite(stamp_s)) black_box_->push_joints(stamp_s, state.name, state.position);
    if (question_hz_ == 0) ask();
  }
  void on_stop(const std::string& why) override {
    stop_commands(why);
    answers_.stop(why, separation_settings().has_value());
  }
  void stop_commands(const std::string& why) {
    if (commands_) commands_->stopped(why);
  }
  void tell_outputs(StatusLog& log) override {
    if (commands_) log.tell("velocity filter", commands_->trouble(), StatusLog::now_s());
  }
  /// Whether somebody obeys what was said last.
  bool is_obeyed() const { return commands_ || separation_settings(); }
  std::function<void()> make_for(const LiveRobot& robot) override {
    const auto separation = separation_settings();
    const auto filter = std::make_shared<VelocityCommands::Filter>();
    if (commands_ && robot.robot) {
      require_period(*settings().filter(), question_hz_);
      *filter = commands_->make(robot.robot, *settings().filter());
    }
    std::shared_ptr<berth::MonitorLoop> loop;
    std::shared_ptr<RobotSpace> space;
    std::shared_ptr<berth::DistanceRows> rows;
    if (robot.robot) {
      loop = std::make_shared<berth::MonitorLoop>(robot.robot, camera_names(), separation);
      space = std::make_shared<RobotSpace>(robot, camera_names().size());
      rows = std::make_shared<berth::DistanceRows>(robot.robot);
    }
    return [this, robot, separation, filter, loop, space, rows] {
      exposures_.use(robot.robot, camera_names());
      keep_space(space);
      const std::lock_guard lock(query_mutex_);
      loop_ = loop;
      asked_space_ = space;
      rows_ = rows;
      if (commands_) commands_->use(std::move(*filter));
      robot_ = robot;
      if (robot.robot) planned_.begin_anew(robot.robot->model());
      black_box_->use(robot.robot, separation, camera_names().size());
      may_be_degraded_ = separation && separation->camera != berth::UnknownPolicy::stop;
    };
  }
  /// For the cameras' threads, which do not wait for questions.
  void keep_space(std::shared_ptr<RobotSpace> space) {
    const std::lock_guard lock(space_mutex_);
    space_.swap(space);
  }
  std::shared_ptr<RobotSpace> space() const {
    const std::lock_guard lock(space_mutex_);
    return space_;
  }

  void ask() {
    look_at_clock();
    const std::lock_guard lock(query_mutex_);
    answer_or_stop();
  }

  /// Silence is no stop: where no joint state asks, or an answer takes long, this does.
  void end_silence() {
    if (answers_.silent_s() < kMostSilence_s || (question_hz_ > 0 && !is_obeyed())) return;
    look_at_clock();
    const std::unique_lock lock(query_mutex_, std::try_to_lock);
    if (lock) return answer_or_stop();
    if (is_obeyed()) on_stop("an answer takes too long");
  }

  /// With the query's mutex.
  void answer_or_stop() {
    const auto begin = std::chrono::steady_clock::now();
    const std::int64_t stops = answers_.stops();
    const std::string why = why_silent(robot_);
    if (!why.empty()) {
      on_stop(why);
    } else {
      auto message = std::make_shared<LinkDistances>();
      try {
        answer(*message);
      } catch (const std::exception& error) {
        on_stop(error.what());
        throw;
      }
      answer_.distances = std::move(message);
      answers_.say(stops, answer_);
    }
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    times_.add(took.count());
  }

  void answer(LinkDistances& message) {
    const LiveFrames frames = this->frames(*robot_.robot);
    const std::shared_ptr<const berth::PreparedSpace> ready = asked_space_->live.newest();
    const berth::JointBuffer& joints = robot_.joints->buffer();
    // Later than any image and any joint state that it asks about.
    const rclcpp::Time now = this->now();
    const double now_s = clock_.seconds(now);
    const berth::Request request{.frames = is_still(*ready, frames) ? berth::NewestFrames(ready)
                                                                    : berth::NewestFrames(frames),
                                 .joints = requested_joints(joints, now_s),
                                 .now_s = now_s,
                                 .X_WB = root_at(*robot_.robot, joints.newest_stamp_s())};
    const berth::Result& result = ask_loop(request);
    to_message(result, base_frame(), now, clock_, message);
    if (result.separation) {
      to_message(result, planned_.is_there(), answer_.separation);
    } else {
      say_unmonitored(answer_.separation);
      if (result.status != berth::ResultStatus::ok) {
        answer_.separation.text = berth::status_text(result);
      }
    }
    to_message(message, may_be_degraded_, answer_.separation);
    steer(result, message);
  }

  /// What a controller may do after this result, and rows for one that finds it itself.
  void steer(const berth::Result& result, const LinkDistances& message) {
    if (commands_) {
      robot_.joints->buffer().newest(steered_joints_);
      commands_->allow(result, steered_joints_.position, velocity_, answer_.velocities);
    }
    if (!answers_.needs_rows()) return answer_.rows.reset();
    if (!answer_.rows) answer_.rows.emplace();
    rows_->update(result);
    to_message(*rows_, robot_.robot->model().joints, message, *answer_.rows);
  }

  /// Velocities are those of the plan where any came, else those of the joints.
  const berth::Result& ask_loop(const berth::Request& request) {
    const berth::Result* result = nullptr;
    black_box_->record(request, [&](berth::Recorder* recorder) {
      loop_->record_with(recorder);
      loop_->ask(request);
      const double now_s = *request.now_s;
      if (answers_.was_stopped()) loop_->stopped(now_s);
      robot_.joints->buffer().velocity(velocity_window_s_, velocity_);
      result = &loop_->monitor(
          planned_.is_there() ? planned_.at(now_s, robot_.robot->settings().time.max_frame_age_s)
                              : velocity_,
          now_s);
    });
    return *result;
  }

  /// The newest ones. Where they come too seldom for questions between them, they are as old as
  /// they get before the next ones come, so that answers do not come and go with each of them.
  berth::RequestedJoints requested_joints(const berth::JointBuffer& joints, double now_s) {
    const double gap_s = longest_joint_gap_s();
    const bool is_seldom =
        question_hz_ > 0 && gap_s > robot_.robot->settings().time.max_joints_age_s;
    if (!is_seldom || joints.newest(seldom_joints_) != berth::TimeStatus::ok) return joints;
    if (seldom_joints_.stamp_s > now_s + berth::kMostJointsAhead_s) return joints;
    seldom_joints_.stamp_s = std::min(seldom_joints_.stamp_s, now_s - gap_s);
    return seldom_joints_;
  }

  std::optional<SpaceNow> space_now() {
    const LiveRobot now = live();
    if (!why_silent(now).empty()) return {};
    return SpaceNow{now.robot, frames(*now.robot), clock_.seconds(this->now())};
  }

  /// Throws std::runtime_error where nothing can be said.
  RobotNow robot_now() {
    const std::shared_ptr<CallbackGate> gate = this->gate();
    const auto pass = gate->enter();
    if (!pass) throw std::runtime_error("the node is not configured");
    const LiveRobot robot = live();
    const std::string why = why_silent(robot);
    if (!why.empty()) throw std::runtime_error(why);
    RobotNow now{.robot = robot.robot, .frames = frames(*robot.robot)};
    const berth::JointBuffer& joints = robot.joints->buffer();
    now.joints_status = joints.newest(now.joints);
    now.X_WB = root_at(*robot.robot, joints.newest_stamp_s());
    // Later than any image and any joint state.
    now.now_s = clock_.seconds(this->now());
    return now;
  }

  void on_plan(const sensor_msgs::msg::JointState& message) {
    const std::lock_guard lock(query_mutex_);
    if (!robot_.robot) return;
    planned_.take(message, robot_.robot->model(), clock_.seconds(message.header.stamp));
  }

  void on_frame(std::size_t camera, const std::shared_ptr<const berth::Frame>& frame,
                berth::DepthView depth_m,
                const std::shared_ptr<const sensor_msgs::msg::Image>&) override {
    black_box_->put(camera, *frame, depth_m);
    const std::shared_ptr<RobotSpace> space = this->space();
    if (space && frame->mounted->robot() == space->robot.robot) space->live.put(camera, frame);
    if (at_exposure_->get_subscription_count() == 0) return;
    auto message = std::make_unique<LinkDistances>();
    if (!exposures_.ask(camera, frame, this->now(), clock_, *message)) return;
    at_exposure_->publish(std::move(message));
  }

  void show() {
    if (markers_->get_subscription_count() == 0) return;
    markers_->publish(markers_of(*answers_.distances()));
  }

  /// The robot's root link, in which results tell points.
  const std::string& base_frame() const { return robot_.robot->model().links.front().name; }

  void report_questions(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::msg::DiagnosticStatus;
    const std::optional<berth::RequestTiming> times = times_.take();
    if (!times) return status.summary(DiagnosticStatus::WARN, "none was asked");
    status.add("questions since the last report", times->repeat);
    status.add("median, us", times->p50_us);
    status.add("99 %, us", times->p99_us);
    status.add("greatest, us", times->max_us);
    if (const std::shared_ptr<RobotSpace> space = this->space()) {
      status.add("spaces made ready", space->live.counts().prepared);
      status.add("made ready in, ms", 1e3 * space->live.counts().last_prepare_s);
    }
    const std::uint8_t result = answers_.distances()->status;
    if (result == LinkDistances::OK) return status.summary(DiagnosticStatus::OK, "answered");
    const bool has_distances = result == LinkDistances::DEGRADED;
    status.summary(has_distances ? DiagnosticStatus::WARN : DiagnosticStatus::ERROR,
                   answers_.text());
  }

  template <class Message>
  using Publisher = typename rclcpp_lifecycle::LifecyclePublisher<Message>::SharedPtr;
  AnswerTopics answers_{*this, camera_names(), settings().command_topic()};
  Publisher<LinkDistances> at_exposure_;
  rclcpp::Subscription<sensor_msgs::msg::JointState>::SharedPtr planned_subscription_;
  Publisher<visualization_msgs::msg::MarkerArray> markers_;
  double question_hz_ = 0;
  double marker_hz_ = 0;
  std::mutex query_mutex_;
  LiveRobot robot_;
  std::shared_ptr<berth::MonitorLoop> loop_;
  /// Of the same robot as loop_.
  std::shared_ptr<RobotSpace> asked_space_;
  mutable std::mutex space_mutex_;
  std::shared_ptr<RobotSpace> space_;
  ExposureAnswers exposures_;
  /// Of a question whose joints come too seldom.
  berth::JointState seldom_joints_;
  AnswerTopics::Answer answer_;
  /// Of the same robot as loop_.
  std::shared_ptr<berth::DistanceRows> rows_;
  /// Where velocities are filtered.
  std::optional<VelocityCommands> commands_;
  berth::JointState steered_joints_;
  double velocity_window_s_ = 0;
  std::vector<double> velocity_;
  /// What the monitor does without a camera was chosen by the user.
  bool may_be_degraded_ = false;
  std::optional<BlackBox> black_box_;
  rclcpp::Service<Trigger>::SharedPtr write_recording_;
  std::optional<PlannerTopics> planners_;
  PlannedVelocity planned_;
  QuestionTimes times_;
  ConfigurationAnswers configurations_{camera_names(), clock_, [this] { return robot_now(); }};
  rclcpp::CallbackGroup::SharedPtr check_group_;
  rclcpp::Service<CheckConfigurations>::SharedPtr check_configurations_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::CallbackGroup::SharedPtr wanted_group_;
  rclcpp::Subscription<VelocityCommands::Message>::SharedPtr wanted_subscription_;
  /// Not to wait for a question.
  rclcpp::CallbackGroup::SharedPtr watchdog_group_;
  rclcpp::TimerBase::SharedPtr question_timer_;
  rclcpp::TimerBase::SharedPtr watchdog_;
  rclcpp::TimerBase::SharedPtr marker_timer_;
};

std::shared_ptr<rclcpp_lifecycle::LifecycleNode> make_distance_node(
    const rclcpp::NodeOptions& options) {
  return std::make_shared<DistanceNode>(options);
}

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::DistanceNode)
