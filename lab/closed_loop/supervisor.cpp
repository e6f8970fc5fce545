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
      frames_(cameras_.size()),
      loop_(robot_, {}, settings),
      shown_(shown) {
  for (const auto& mounted : mounted_cell_cameras(robot_, cameras_, settings.detection_m.value())) {
    observers_.push_back(std::make_unique<Observer>(mounted));
  }
}

void MonitorSupervisor::see(std::size_t which, const DepthImage& depth_m, double stamp_s,
                            const JointBuffer& joints) {
  auto frame = std::make_shared<Frame>();
  observers_[which]->observe(depth_m, stamp_s, joints, *frame);
  frames_[which] = std::move(frame);
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
  loop_.ask({.frames = space_ ? NewestFrames(space_) : NewestFrames(frames_),
             .joints = situation.joints,
             .now_s = situation.now_s});
  const auto answered = Clock::now();
  PlannedMotion motion(situation.plan.velocity_rad_s);
  if (shown_ == ShownBy::along_path) motion.path = situation.path;
  result_ = &loop_.monitor(motion, situation.now_s, shown_ != ShownBy::formula);
  const auto done = Clock::now();
  const auto since = [done](Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(done - start).count();
  };
  monitor_us_.push_back(since(answered));
  request_us_.push_back(since(asked));
  return last().speed_scale;
}

EvadingSupervisor::EvadingSupervisor(std::vector<int> cameras, const SeparationSettings& settings)
    // It leaves its way where it gives way.
    : MonitorSupervisor(std::move(cameras), settings, ShownBy::formula),
      evader_(robot(), "arm_link_7", {}) {}

double EvadingSupervisor::scale(const Situation& situation) {
  const double scale = MonitorSupervisor::scale(situation);
  evasion_.reset();
  if (result().time.status == TimeStatus::ok) evasion_ = evader_.update(result());
  return scale;
}

}  // namespace berth::lab
