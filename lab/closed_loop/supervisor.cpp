#include "lab/closed_loop/supervisor.hpp"

#include <chrono>
#include <utility>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {

void Supervisor::see(std::size_t, const DepthImage&, double, const JointBuffer&) {}

MonitorSupervisor::MonitorSupervisor(std::vector<int> cameras, const SeparationSettings& settings,
                                     ShownBy shown, std::optional<double> deadline_us)
    : robot_(cell_robot(deadline_us)),
      cameras_(std::move(cameras)),
      pools_(cameras_.size()),
      frames_(cameras_.size()),
      loop_(robot_, {}, settings),
      shown_(shown) {
  for (const auto& mounted : mounted_cell_cameras(robot_, cameras_, settings.detection_m.value())) {
    observers_.push_back(std::make_unique<Observer>(mounted));
  }
}

void MonitorSupervisor::see(std::size_t which, const DepthImage& depth_m, double stamp_s,
                            const JointBuffer& joints) {
  const std::shared_ptr<Frame> frame = pools_[which].take();
  observers_[which]->observe(depth_m, stamp_s, joints, *frame);
  frames_[which] = frame;
  if (!robot_->settings().distance.deadline_us) return;
  JointState now;
  if (joints.newest(now) != TimeStatus::ok) return;
  const auto space =
      spaces_.take([this] { return std::make_unique<PreparedSpace>(robot_, cameras_.size()); });
  space->prepare(frames_, &now);
  space_ = space;
}

double MonitorSupervisor::scale(const Situation& situation) {
  using Clock = std::chrono::steady_clock;
  const auto asked = Clock::now();
  ask(situation);
  const auto answered = Clock::now();
  PlannedMotion motion(situation.plan.velocity_rad_s);
  if (shown_ == ShownBy::along_path) motion.path = situation.path;
  const double scale = monitor(motion, situation.now_s, shown_ != ShownBy::formula);
  const auto done = Clock::now();
  const auto since = [done](Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(done - start).count();
  };
  monitor_us_.push_back(since(answered));
  request_us_.push_back(since(asked));
  return scale;
}

const Result& MonitorSupervisor::ask(const Situation& situation) {
  return loop_.ask({.frames = space_ ? NewestFrames(space_) : NewestFrames(frames_),
                    .joints = situation.joints,
                    .now_s = situation.now_s});
}

double MonitorSupervisor::monitor(const PlannedMotion& motion, double now_s, bool with_frames) {
  result_ = &loop_.monitor(motion, now_s, with_frames);
  return last().speed_scale;
}

}  // namespace berth::lab
