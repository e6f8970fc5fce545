// What both nodes have: settings, the robot's model and joints, cameras, diagnostics of these.
#pragma once

#include <atomic>
#include <diagnostic_updater/diagnostic_updater.hpp>
#include <memory>
#include <mutex>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <sensor_msgs/msg/joint_state.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/set_bool.hpp>
#include <string>
#include <vector>

#include "attachments.hpp"
#include "callback_gate.hpp"
#include "camera_explanations.hpp"
#include "camera_input.hpp"
#include "clock_watch.hpp"
#include "image_node.hpp"
#include "joint_rhythm.hpp"
#include "node_settings.hpp"
#include "stamp_clock.hpp"
#include "status_log.hpp"
#include "transforms.hpp"

#ifdef BERTH_ROS_MOVEIT
#include "moveit_attached.hpp"
#endif

namespace berth_ros {

/// The newest frame of each camera, or null where it has none yet.
using LiveFrames = std::vector<std::shared_ptr<const berth::Frame>>;

/// The robot and its joints, as they are used at the moment.
struct LiveRobot {
  std::shared_ptr<const berth::Robot> robot;
  std::shared_ptr<berth::JointIntake> joints;
  /// Of LiveNode::beginnings_, when this was made.
  int beginnings = 0;
};

/// A lifecycle node: configured it listens, active it answers. With the parameter `autostart` it
/// goes there by itself.
class LiveNode : public rclcpp_lifecycle::LifecycleNode {
 public:
  using State = rclcpp_lifecycle::State;
  using CallbackReturn = rclcpp_lifecycle::node_interfaces::LifecycleNodeInterface::CallbackReturn;

  CallbackReturn on_configure(const State& before) final;
  CallbackReturn on_activate(const State& before) final;
  CallbackReturn on_deactivate(const State& before) final;
  CallbackReturn on_cleanup(const State& before) final;
  CallbackReturn on_shutdown(const State& before) final;

 protected:
  /// Throws std::exception for a bad file or parameter.
  LiveNode(const std::string& name, const rclcpp::NodeOptions& options, bool has_one_camera);
  /// To be called at the end of the constructor of who derives, once its parameters are declared:
  /// refuses those that nobody declared, and starts by itself where that is asked for.
  void begin();
  /// Says the last word, and ends the cameras' threads and what calls back; to be called first by
  /// the destructor of who derives.
  void end();

  /// Makes publishers and what else is needed; before any callback.
  virtual void configure_outputs() = 0;
  /// The images' node is there, and spins after this.
  virtual void on_images() {}
  virtual void activate_outputs() {}
  /// The last moment at which something can be said.
  virtual void deactivate_outputs() {}
  /// No callback runs any more.
  virtual void clean_outputs() = 0;
  /// A frame was observed, in its camera's thread.
  virtual void on_frame(std::size_t camera, const std::shared_ptr<const berth::Frame>& frame,
                        berth::DepthView depth_m,
                        const std::shared_ptr<const sensor_msgs::msg::Image>& image) = 0;
  /// Joint states came, whatever became of them; their stamp is NaN where it is no time.
  virtual void on_joints(double, const sensor_msgs::msg::JointState&) {}
  /// Makes what a robot needs before any camera uses it; null: there is none. What it returns is
  /// called once all do. Throws std::exception where it cannot be, and has then changed nothing.
  virtual std::function<void()> make_for(const LiveRobot&) {
    return [] {};
  }
  /// To tell the log what else is lost, often.
  virtual void tell_outputs(StatusLog&) {}
  /// What was said holds no more, whatever comes next.
  virtual void on_stop(const std::string&) {}

  /// Why nothing can be said of this robot: the node is not active, or disabled, there is none, no
  /// time is known, or all is about to begin anew. Empty where it can.
  std::string why_silent(const LiveRobot& robot) const;
  /// Begins anew where time went back by the node's clock. To be called often, without a mutex.
  void look_at_clock();
  LiveRobot live() const;
  /// None: nothing is monitored.
  std::optional<berth::SeparationSettings> separation_settings() const {
    return settings_.separation();
  }
  const NodeSettings& settings() const { return settings_; }
  /// The newest of each camera of this robot.
  LiveFrames frames(const berth::Robot& robot) const;
  /// Of the last joint samples.
  double longest_joint_gap_s() const;
  /// Where the robot's root stands at this time: none where it does not move, not finite where
  /// nobody knows.
  std::optional<berth::Pose> root_at(const berth::Robot& robot, double stamp_s);
  const std::vector<std::string>& camera_names() const { return camera_names_; }
  /// Of a node with one camera.
  const CameraSettings& camera_settings() const { return inputs_.front()->settings(); }
  ImageNode& images() { return *images_; }
  /// Of this configuration: to be passed by each callback of the node that uses what
  /// configure_outputs() made. Never null.
  std::shared_ptr<CallbackGate> gate() const;

  /// Of the node's whole life: to be passed by each callback that no configuration makes. Closed by
  /// end().
  const std::shared_ptr<CallbackGate>& life() const { return life_; }

  /// Adds to the diagnostics.
  void add_report(const std::string& name, const diagnostic_updater::TaskFunction& report);

  StampClock clock_;
  diagnostic_updater::Updater diagnostics_;

 private:
  /// Throws std::exception for a bad file.
  void start();
  void stop();
  void listen();
  /// Says the last word.
  void deactivate();
  /// Joints, images, transforms and answers: nothing that came before holds any more.
  void begin_anew(const std::string& why);
  /// Where the parameter asks for it. Throws where this build cannot.
  void follow_moveit();
  void make_cameras();
  void make_explanations(const std::vector<CameraSettings>& cameras);
  /// Images may wait for what has come.
  void look_again();
  void take_parameters();
  void on_description(const std_msgs::msg::String& description);
  void on_joint_state(const sensor_msgs::msg::JointState& state);
  std::shared_ptr<CallbackGate> make_gate();
  // All that makes the robot anew is called with making_mutex_.
  /// See ChangeAttached.
  void change_attached(const std::function<void(Attached&)>& change);
  /// To be called where there is a model.
  LiveRobot make_robot(const AttachmentList& attached) const;
  /// Throws as make_for().
  void use(const LiveRobot& made);
  void load_model(const std::function<berth::RobotModel()>& load);
  /// Tells the log how all stands.
  void watch();
  std::string robot_trouble() const;
  /// Once.
  std::string callback_trouble();
  std::string joint_trouble(const LiveRobot& robot, double now_s) const;
  std::string camera_trouble(std::size_t camera, const CameraReport& report, const LiveRobot& robot,
                             double now_s) const;
  /// What several images say is wrong with the camera as it is; empty where nothing is, or nobody
  /// knows.
  std::string explanation(std::size_t camera, const CameraReport& report) const;
  /// Why the monitor's C is not that of what it was told the cameras detect; empty: it is.
  std::string protection_trouble(const CameraReport& report) const;
  void report_robot(diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_joints(diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_camera(std::size_t camera, diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_input(std::size_t camera, diagnostic_updater::DiagnosticStatusWrapper& status);
  void report_frame(const berth::Frame& frame, const berth::Robot& robot,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

  bool has_one_camera_;
  NodeSettings settings_;
  std::vector<std::string> camera_names_;
  std::shared_ptr<CallbackGate> life_;
  ClockWatch clock_watch_;
  /// How often all began anew, with another robot model or time. What was made before one holds no
  /// more, from its begin on.
  std::atomic<int> beginnings_ = 0;
  std::atomic<bool> is_active_ = false;
  std::atomic<bool> is_enabled_ = true;

  /// Held while a robot is made and all are told of it, so that the last one that was made is the
  /// one that all use. Taken after a gate, and before any other mutex.
  std::mutex making_mutex_;
  std::optional<berth::RobotModel> model_;
  std::string description_;
  Attached attached_;
  mutable std::mutex mutex_;
  std::string robot_trouble_;
  LiveRobot live_;
  /// Of live_.joints.
  JointRhythm rhythm_;
  std::int64_t joint_messages_ = 0;
  std::int64_t refused_joint_messages_ = 0;
  std::string joint_trouble_;
  /// What a callback threw since the log was told last.
  std::string callback_trouble_;
  /// The greatest age of the newest joints since the last report, as it was sampled.
  double oldest_joints_s_ = 0;
  /// Closed as long as nothing is configured. Another one for each configuration, so that a
  /// callback of an earlier one never finds it open.
  std::shared_ptr<CallbackGate> gate_;
  std::optional<Transforms> transforms_;
  std::unique_ptr<ImageNode> images_;
  std::vector<std::unique_ptr<CameraInput>> inputs_;
  /// Ends before the inputs do, which it reports.
  std::unique_ptr<CameraExplanations> explanations_;
  std::optional<StatusLog> log_;
  std::optional<Attachments> attachments_;
#ifdef BERTH_ROS_MOVEIT
  std::optional<MoveItAttached> moveit_;
#endif
  std::vector<berth::LiveCameraCounts> reported_images_;
  std::int64_t reported_joints_ = 0;
  rclcpp::Time reported_joints_at_;
  std::vector<rclcpp::Time> reported_images_at_;

  rclcpp::CallbackGroup::SharedPtr joints_group_;
  rclcpp::CallbackGroup::SharedPtr robot_group_;
  rclcpp::CallbackGroup::SharedPtr watch_group_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr description_subscription_;
  rclcpp::Subscription<sensor_msgs::msg::JointState>::SharedPtr joint_subscription_;
  rclcpp::Service<std_srvs::srv::SetBool>::SharedPtr enable_;
  rclcpp::TimerBase::SharedPtr watch_timer_;
  OnSetParametersCallbackHandle::SharedPtr parameters_;
  std::optional<rclcpp::PreShutdownCallbackHandle> at_shutdown_;
};

}  // namespace berth_ros
