// Distances of a running robot: cameras and joint states in, berth_msgs/LinkDistances out.
#include <atomic>
#include <berth_msgs/msg/link_distances.hpp>
#include <berth_msgs/msg/separation.hpp>
#include <chrono>
#include <deque>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_msgs/msg/float64.hpp>
#include <visualization_msgs/msg/marker_array.hpp>

#include "berth/pipeline/query.hpp"
#include "live_node.hpp"
#include "markers.hpp"
#include "nodes.hpp"
#include "question_times.hpp"
#include "result_messages.hpp"
#include "speed_monitor.hpp"

namespace berth_ros {
namespace {

rcl_interfaces::msg::ParameterDescriptor rate(const std::string& text, double most) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = true;
  descriptor.floating_point_range.resize(1);
  descriptor.floating_point_range[0].to_value = most;
  return descriptor;
}

rcl_interfaces::msg::ParameterDescriptor described_number(const std::string& text) {
  rcl_interfaces::msg::ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = true;
  return descriptor;
}

}  // namespace

class DistanceNode : public LiveNode {
 public:
  explicit DistanceNode(const rclcpp::NodeOptions& options)
      : LiveNode("distance_node", options, false) {
    const rclcpp::QoS qos = rclcpp::QoS(10);
    distances_ = create_publisher<berth_msgs::msg::LinkDistances>("distances", qos);
    at_exposure_ = create_publisher<berth_msgs::msg::LinkDistances>("distances_at_exposure", qos);
    separation_ = create_publisher<berth_msgs::msg::Separation>("separation", qos);
    speed_scale_ = create_publisher<std_msgs::msg::Float64>("speed_scale", qos);
    markers_ = create_publisher<visualization_msgs::msg::MarkerArray>("markers", qos);
    diagnostics_.add("questions", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
      report_questions(status);
    });
    const double question_hz = declare_parameter(
        "question_rate_hz", 100.0, rate("questions a second; 0: one for each joint state", 1000));
    const double marker_hz =
        declare_parameter("marker_rate_hz", 10.0, rate("markers a second; 0: none", 100));
    velocity_window_s_ = declare_parameter(
        "velocity_window_s", 0.02,
        described_number("over how long a time of joint states velocities are measured, where no "
                         "planned_joint_states come"));
    asks_on_joints_ = question_hz == 0;
    group_ = create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    if (question_hz > 0) question_timer_ = timer(question_hz, [this] { ask(); });
    if (marker_hz > 0) marker_timer_ = timer(marker_hz, [this] { show(); });
    rclcpp::SubscriptionOptions with_group;
    with_group.callback_group = group_;
    planned_subscription_ = create_subscription<sensor_msgs::msg::JointState>(
        "planned_joint_states", rclcpp::SensorDataQoS().keep_last(1),
        [this](const sensor_msgs::msg::JointState& message) { on_plan(message); }, with_group);
    listen();
  }
  /// Cameras' threads and callbacks use what is below.
  ~DistanceNode() override { stop(); }

 private:
  using LinkDistances = berth_msgs::msg::LinkDistances;

  template <class Call>
  rclcpp::TimerBase::SharedPtr timer(double hz, Call call) {
    return rclcpp::create_timer(this, get_clock(), rclcpp::Duration::from_seconds(1 / hz), call,
                                group_);
  }

  void on_joints() override {
    if (asks_on_joints_) ask();
  }
  void on_robot() override {
    const LiveRobot now = live();
    const std::lock_guard lock(query_mutex_);
    query_.reset();
    exposure_query_.reset();
    robot_ = now;
    recent_.assign(camera_names().size(), {});
    monitor_.reset();
    planned_ = {};
    const std::optional<berth::SeparationSettings> separation = separation_settings();
    is_monitored_ = separation.has_value();
    if (!now.robot) return;
    if (separation) monitor_.emplace(now.robot, *separation, velocity_window_s_);
    query_.emplace(now.robot, camera_names());
    exposure_query_.emplace(now.robot, camera_names());
  }

  void ask() {
    const auto begin = std::chrono::steady_clock::now();
    auto message = std::make_unique<LinkDistances>();
    bool is_told = false;
    {
      const std::lock_guard lock(query_mutex_);
      const LiveFrames frames = robot_.robot ? this->frames(*robot_.robot) : LiveFrames();
      // Later than any image and any joint state that it asks about.
      const rclcpp::Time now = this->now();
      if (query_) {
        const berth::JointBuffer& joints = robot_.joints->buffer();
        const double now_s = clock_.seconds(now);
        result_ = query_->ask({.frames = frames, .joints = joints, .now_s = now_s});
        to_message(result_, base_frame(), now, clock_, *message);
        if (monitor_) {
          monitor_->update(result_, joints, planned_, now_s, separation_message_);
        } else {
          say_unmonitored(separation_message_);
        }
      } else {
        say_no_robot(camera_names(), now, *message);
        if (is_monitored_) {
          say_stop("there is no robot model", separation_message_);
        } else {
          say_unmonitored(separation_message_);
        }
      }
      to_message(*message, separation_message_);
      is_told = is_monitored_;
      last_status_ = message->status;
      last_time_status_ = message->time_status;
      if (marker_timer_) last_ = *message;
    }
    distances_->publish(std::move(message));
    separation_->publish(separation_message_);
    if (is_told) {
      std_msgs::msg::Float64 scale;
      scale.data = separation_message_.speed_scale;
      speed_scale_->publish(scale);
    }
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    times_.add(took.count());
  }

  void on_plan(const sensor_msgs::msg::JointState& message) {
    const std::lock_guard lock(query_mutex_);
    if (robot_.robot) planned_.take(message, robot_.robot->model(), clock_.seconds(this->now()));
  }

  void on_frame(std::size_t camera, const berth::Frame& frame,
                const std::shared_ptr<const sensor_msgs::msg::Image>&) override {
    if (at_exposure_->get_subscription_count() == 0) return;
    auto message = std::make_unique<LinkDistances>();
    {
      const std::lock_guard lock(query_mutex_);
      if (!exposure_query_) return;
      keep_recent(camera);
      const LiveFrames frames = frames_at(frame.stamp_s);
      to_message(exposure_query_->ask({.frames = frames}), base_frame(), this->now(), clock_,
                 *message);
    }
    at_exposure_->publish(std::move(message));
  }
  void keep_recent(std::size_t camera) {
    auto& recent = recent_[camera];
    if (recent.size() == kRecent) recent.pop_front();
    recent.push_back(frames(*robot_.robot)[camera]);
  }
  /// Each camera's newest frame of that time: another camera's thread may be ahead.
  LiveFrames frames_at(double stamp_s) const {
    LiveFrames frames(recent_.size());
    for (std::size_t c = 0; c < frames.size(); ++c) {
      for (const auto& frame : recent_[c]) {
        if (frame && frame->stamp_s <= stamp_s) frames[c] = frame;
      }
    }
    return frames;
  }

  void show() {
    if (markers_->get_subscription_count() == 0) return;
    visualization_msgs::msg::MarkerArray array;
    {
      const std::lock_guard lock(query_mutex_);
      array = markers_of(last_);
    }
    markers_->publish(array);
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
    std::uint8_t result = 0;
    std::uint8_t time = 0;
    {
      const std::lock_guard lock(query_mutex_);
      result = last_status_;
      time = last_time_status_;
    }
    if (result == LinkDistances::OK) return status.summary(DiagnosticStatus::OK, "answered");
    if (result == LinkDistances::DEGRADED) {
      return status.summary(DiagnosticStatus::WARN, "answered without a camera");
    }
    const std::string why = time < berth::kTimeStatusCount
                                ? std::string(berth::kTimeStatusNames[time])
                                : "no robot model";
    status.summary(DiagnosticStatus::ERROR, "no distances: " + why);
  }

  rclcpp::Publisher<LinkDistances>::SharedPtr distances_;
  rclcpp::Publisher<LinkDistances>::SharedPtr at_exposure_;
  rclcpp::Publisher<berth_msgs::msg::Separation>::SharedPtr separation_;
  rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr speed_scale_;
  rclcpp::Subscription<sensor_msgs::msg::JointState>::SharedPtr planned_subscription_;
  rclcpp::Publisher<visualization_msgs::msg::MarkerArray>::SharedPtr markers_;
  static constexpr std::size_t kRecent = 4;
  /// Of each camera, for distances_at_exposure.
  std::vector<std::deque<std::shared_ptr<const berth::Frame>>> recent_;
  bool asks_on_joints_ = false;
  std::mutex query_mutex_;
  LiveRobot robot_;
  std::optional<berth::Query> query_;
  std::optional<berth::Query> exposure_query_;
  /// The newest, with its separation.
  berth::Result result_;
  /// For markers, where there are any.
  LinkDistances last_;
  std::uint8_t last_status_ = LinkDistances::STALE;
  std::uint8_t last_time_status_ = LinkDistances::TIME_NO_ROBOT;
  berth_msgs::msg::Separation separation_message_;
  double velocity_window_s_ = 0;
  bool is_monitored_ = false;
  std::optional<SpeedMonitor> monitor_;
  PlannedVelocity planned_;
  QuestionTimes times_;
  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::TimerBase::SharedPtr question_timer_;
  rclcpp::TimerBase::SharedPtr marker_timer_;
};

std::shared_ptr<rclcpp::Node> make_distance_node(const rclcpp::NodeOptions& options) {
  return std::make_shared<DistanceNode>(options);
}

}  // namespace berth_ros

RCLCPP_COMPONENTS_REGISTER_NODE(berth_ros::DistanceNode)
