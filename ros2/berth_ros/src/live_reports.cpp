// How a LiveNode stands, for the log and for diagnostics.
#include <algorithm>
#include <cmath>

#include "berth/pipeline/timeliness.hpp"
#include "berth/results/result_text.hpp"
#include "berth/separation/protective_distance.hpp"
#include "live_node.hpp"

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

bool waits_for_joints(const CameraReport& report) {
  using berth::TimeStatus;
  if (!report.trouble.empty() || !report.newest) return false;
  const TimeStatus status = report.newest->time.status;
  return status == TimeStatus::no_joints || status == TimeStatus::missing_joint ||
         status == TimeStatus::extrapolated_too_far || status == TimeStatus::skewed;
}

/// A line begins with the camera's name already.
std::string without_name(std::string text, const std::string& camera) {
  for (const std::string& name : {"camera " + camera + ": ", "camera " + camera + " "}) {
    if (text.rfind(name, 0) == 0) return text.erase(0, name.size());
  }
  return text;
}

std::string in_ms(double seconds) { return std::to_string(std::lround(1e3 * seconds)) + " ms"; }

}  // namespace

void LiveNode::watch() {
  const double now_s = StatusLog::now_s();
  look_at_clock();
  const LiveRobot robot = live();
  log_->tell("robot", robot_trouble(), now_s);
  log_->tell("clock", clock_watch_.stands() ? "stands" : "", now_s);
  log_->tell("messages", callback_trouble(), now_s);
  // What else is missing is told once this is there.
  if (!robot.robot) return;
  const double clock_s = clock_.seconds(this->now());
  {
    const double age_s = clock_s - robot.joints->buffer().newest_stamp_s();
    const std::lock_guard lock(mutex_);
    if (age_s > oldest_joints_s_) oldest_joints_s_ = age_s;
  }
  const std::string joints = joint_trouble(robot, clock_s);
  log_->tell("joint states", joints, now_s);
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const CameraReport report = inputs_[i]->report();
    const std::string name = "camera " + camera_names_[i];
    log_->tell("images of " + name, report.rate.trouble(), now_s);
    // Without joints no image can be used: one line reports on both.
    if (!joints.empty() && waits_for_joints(report)) continue;
    log_->tell(name, camera_trouble(i, report, robot, clock_s), now_s,
               !report.pose_trouble.empty());
    log_->tell(name + " over several images", explanation(i, report), now_s);
    log_->tell("protection by " + name, protection_trouble(report), now_s);
  }
  tell_outputs(*log_);
}

std::string LiveNode::callback_trouble() {
  const std::lock_guard lock(mutex_);
  return std::exchange(callback_trouble_, {});
}

std::string LiveNode::robot_trouble() const {
  const std::lock_guard lock(mutex_);
  return live_.robot ? "" : robot_trouble_;
}

std::string LiveNode::joint_trouble(const LiveRobot& robot, double now_s) const {
  if (!robot.joints) return "no robot model yet";
  const double max_age_s = robot.robot->settings().time.max_joints_age_s;
  const double age_s = now_s - robot.joints->buffer().newest_stamp_s();
  const std::string waiting_for(robot.joints->waiting_for());
  const std::lock_guard lock(mutex_);
  // NaN, which is no limit's, too.
  if (!(age_s <= max_age_s + 1)) {
    if (!joint_trouble_.empty()) return joint_trouble_;
    return "no new joint states" +
           (waiting_for.empty() ? "" : " (waiting for joint " + waiting_for + ")");
  }
  if (!joint_trouble_.empty()) return "the newest message was refused: " + joint_trouble_;
  const double oldest_s = std::max(age_s, rhythm_.longest_gap_s());
  if (oldest_s <= max_age_s) return "";
  return "the newest are up to " + in_ms(oldest_s) + " old; time.max_joints_age_s allows " +
         in_ms(max_age_s);
}

std::string LiveNode::camera_trouble(std::size_t number, const CameraReport& report,
                                     const LiveRobot& robot, double now_s) const {
  if (!report.trouble.empty()) return report.trouble;
  if (!robot.robot) return "no robot model yet";
  if (!report.newest) return "no image observed yet";
  berth::CameraResult camera;
  static_cast<berth::CameraState&>(camera) =
      berth::camera_state(report.newest.get(), now_s, robot.robot->settings().time);
  camera.camera = report.newest->mounted->mount().name;
  std::string trouble = without_name(berth::camera_text(camera), camera.camera);
  const std::string why = explanation(number, report);
  if (!report.newest->watch.is_trusted() && !why.empty()) return trouble + ": " + why;
  // Images that wait for transforms may also be dropped for newer ones, until the last one is old.
  const bool lacks_pose = !trouble.empty() && !report.pose_trouble.empty();
  return lacks_pose ? trouble + ": " + report.pose_trouble : trouble;
}

std::string LiveNode::protection_trouble(const CameraReport& report) const {
  const std::optional<berth::SeparationSettings> separation = separation_settings();
  if (!separation || !report.newest) return "";
  return berth::detection_trouble(*separation, *report.newest->mounted);
}

std::string LiveNode::explanation(std::size_t camera, const CameraReport& report) const {
  const CameraExplanation told = explanations_->newest(camera);
  if (!told.mounted || !report.newest) return "";
  const berth::CameraMount& mount = report.newest->mounted->mount();
  if (!is_same_mount(told.mounted->mount(), mount)) return "";
  return without_name(told.text, mount.name);
}

void LiveNode::report_robot(DiagnosticStatusWrapper& status) {
  const std::lock_guard lock(mutex_);
  if (!live_.robot) {
    return status.summary(DiagnosticStatus::ERROR,
                          is_active_ ? robot_trouble_ : "the node is not active");
  }
  status.summary(DiagnosticStatus::OK, "loaded");
  status.add("robot", live_.robot->model().name);
  status.add("links evaluated", live_.robot->model().link_count());
  status.add("joints", live_.robot->model().joints.size());
}

void LiveNode::report_joints(DiagnosticStatusWrapper& status) {
  const LiveRobot robot = live();
  const rclcpp::Time now = this->now();
  double oldest_s = 0;
  {
    const std::lock_guard lock(mutex_);
    status.add("messages a second",
               rate_since(joint_messages_, now, reported_joints_, reported_joints_at_));
    status.add("refused", refused_joint_messages_);
    oldest_s = std::exchange(oldest_joints_s_, 0);
  }
  if (!robot.joints) return status.summary(DiagnosticStatus::WARN, "no robot model yet");
  const double age_s = clock_.seconds(now) - robot.joints->buffer().newest_stamp_s();
  const double max_age_s = robot.robot->settings().time.max_joints_age_s;
  const std::string waiting_for(robot.joints->waiting_for());
  status.add("age of the newest whole sample, s", age_s);
  status.add("greatest age since the last report, s", oldest_s);
  status.add("began anew", beginnings_.load());
  if (!waiting_for.empty()) status.add("waiting for joint", waiting_for);
  const std::string trouble = joint_trouble(robot, clock_.seconds(now));
  if (!(age_s <= max_age_s + 1)) return status.summary(DiagnosticStatus::ERROR, trouble);
  if (!trouble.empty()) return status.summary(DiagnosticStatus::WARN, trouble);
  if (oldest_s > max_age_s) {
    return status.summary(DiagnosticStatus::WARN, "now and then they are " + in_ms(oldest_s) +
                                                      " old; time.max_joints_age_s allows " +
                                                      in_ms(max_age_s));
  }
  status.summary(DiagnosticStatus::OK, "coming");
}

void LiveNode::report_camera(std::size_t camera, DiagnosticStatusWrapper& status) {
  const std::shared_ptr<CallbackGate> gate = this->gate();
  const auto pass = gate->enter();
  if (pass && camera < inputs_.size()) return report_input(camera, status);
  status.summary(DiagnosticStatus::WARN, "the node is not configured");
}

void LiveNode::report_input(std::size_t camera, DiagnosticStatusWrapper& status) {
  const CameraReport report = inputs_[camera]->report();
  const rclcpp::Time now = this->now();
  berth::LiveCameraCounts& before = reported_images_[camera];
  const std::string overload = overload_trouble(before, report.counts);
  status.add("images a second",
             rate_since(report.counts.images, now, before.images, reported_images_at_[camera]));
  before = report.counts;
  if (report.rate.is_known()) {
    status.add("images a second that the camera sends", report.rate.sent_hz());
    status.add("images a second that arrive", report.rate.arrived_hz());
  }
  status.add("dropped", report.counts.dropped);
  status.add("refused", report.refused);
  status.add("stale", report.counts.stale);
  status.add("waited for joints, ms", 1e3 * report.counts.last_wait_s);
  status.add("longest wait, ms", 1e3 * report.counts.longest_wait_s);
  status.add("observed in, ms", 1e3 * report.counts.last_observe_s);
  status.add("pose from", report.pose_from);
  status.add("poses so far", report.mounts);
  const LiveRobot robot = live();
  if (report.newest && robot.robot) report_frame(*report.newest, *robot.robot, status);
  const double now_s = clock_.seconds(now);
  status.add("looked at over several images", explanations_->newest(camera).looks);
  const std::string trouble = camera_trouble(camera, report, robot, now_s);
  const std::string lost = report.rate.trouble().empty() ? overload : report.rate.trouble();
  if (trouble.empty()) {
    return lost.empty() ? status.summary(DiagnosticStatus::OK, "ok")
                        : status.summary(DiagnosticStatus::WARN, lost);
  }
  const bool is_lost =
      !report.trouble.empty() || !report.newest || !robot.robot ||
      !berth::is_used(
          berth::camera_state(report.newest.get(), now_s, robot.robot->settings().time).status);
  const bool is_waiting = report.trouble.empty() && (!report.newest || !robot.robot);
  // Where none arrives any more, those before tell why.
  status.summary(is_lost && !is_waiting ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN,
                 lost.empty() ? trouble : trouble + "; before: " + lost);
}

void LiveNode::report_frame(const berth::Frame& frame, const berth::Robot& robot,
                            DiagnosticStatusWrapper& status) {
  const auto pixels = static_cast<double>(frame.obstacles.fate.pixels().size());
  for (int i = 0; pixels > 0 && i < berth::kPixelFateCount; ++i) {
    const auto fate = static_cast<berth::PixelFate>(i);
    if (frame.obstacles.count[i] == 0) continue;
    status.add("share of pixels: " + std::string(name_of(fate)), frame.obstacles.count[i] / pixels);
  }
  const berth::CameraState state =
      berth::camera_state(&frame, clock_.seconds(this->now()), robot.settings().time);
  status.add("age of the newest image, s", state.age_s);
  if (state.watch.is_on) {
    status.add("seen through the robot", state.watch.seen_through);
    status.add("robot displaced by, m", state.watch.displacement_m);
  }
  if (state.watch.is_implausible) {
    status.add("share of readings at the robot's surface", state.watch.at_robot);
  }
}

}  // namespace berth_ros
