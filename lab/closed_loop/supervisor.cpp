#include "lab/closed_loop/supervisor.hpp"

#include <chrono>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {

void Supervisor::see(std::size_t, const DepthImage&, double, const JointBuffer&) {}

MonitorSupervisor::MonitorSupervisor(Method method, std::vector<int> cameras,
                                     const SeparationSettings& settings, ShownBy shown)
    : robot_(cell_robot()),
      cameras_(std::move(cameras)),
      frames_(cameras_.size()),
      query_(robot_, method),
      monitor_(robot_, settings),
      shown_(shown) {
  for (const auto& view : cell_views(robot_, cameras_, settings.detection_m.value())) {
    observers_.push_back(std::make_unique<Observer>(view));
  }
}

void MonitorSupervisor::see(std::size_t which, const DepthImage& depth_m, double stamp_s,
                            const JointBuffer& joints) {
  auto frame = std::make_shared<Frame>();
  observers_[which]->observe(depth_m, stamp_s, joints, *frame);
  frames_[which] = std::move(frame);
}

double MonitorSupervisor::scale(const Situation& situation) {
  result_ = &query_.ask({.frames = frames_, .joints = situation.joints, .now_s = situation.now_s});
  const auto start = std::chrono::steady_clock::now();
  PlannedMotion motion(situation.plan.velocity_rad_s);
  if (shown_ == ShownBy::along_path) motion.path = situation.path;
  last_ = &monitor_.update(*result_, motion, situation.now_s,
                           shown_ == ShownBy::formula ? nullptr : query_.frames());
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
  monitor_us_.push_back(took.count());
  return last_->speed_scale;
}

EvadingSupervisor::EvadingSupervisor(Method method, std::vector<int> cameras,
                                     const SeparationSettings& settings)
    // It leaves its way where it gives way.
    : MonitorSupervisor(method, std::move(cameras), settings, ShownBy::formula),
      evader_(robot(), "arm_link_7", {}) {}

double EvadingSupervisor::scale(const Situation& situation) {
  const double scale = MonitorSupervisor::scale(situation);
  evasion_.reset();
  if (result().time.status == TimeStatus::ok) evasion_ = evader_.update(result());
  return scale;
}

}  // namespace berth::lab
