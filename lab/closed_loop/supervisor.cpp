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

FilteringSupervisor::FilteringSupervisor(std::vector<int> cameras,
                                         const SeparationSettings& settings, double request_hz)
    // It leaves its way where it is led around something.
    : MonitorSupervisor(std::move(cameras), settings, ShownBy::formula),
      filter_(robot(), {.period_s = 1 / request_hz, .latency_s = kController_s}),
      velocity_rad_s_(robot()->model().joints.size(), 0.0) {}

double FilteringSupervisor::scale(const Situation& situation) {
  // How fast it goes back to its way.
  constexpr double kReturn_1_s = 0.8;
  const double scale = MonitorSupervisor::scale(situation);
  wanted_rad_s_.clear();
  if (situation.joints.newest(now_) == TimeStatus::ok) {
    for (std::size_t j = 0; j < now_.position.size(); ++j) {
      const double aside_rad = now_.position[j] - situation.plan.position_rad[j];
      wanted_rad_s_.push_back(scale * (situation.plan.velocity_rad_s[j] - kReturn_1_s * aside_rad));
    }
  }
  velocity_rad_s_ =
      filter_.update(result(), {now_.position, velocity_rad_s_, wanted_rad_s_}).velocity;
  // It goes on along its way by as much as the filter left of what was wanted.
  double left = 0, all = 0;
  for (std::size_t j = 0; j < wanted_rad_s_.size(); ++j) {
    left += velocity_rad_s_[j] * wanted_rad_s_[j];
    all += wanted_rad_s_[j] * wanted_rad_s_[j];
  }
  return all > 0 ? scale * std::clamp(left / all, 0.0, 1.0) : scale;
}

}  // namespace berth::lab
