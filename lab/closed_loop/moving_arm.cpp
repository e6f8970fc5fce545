#include "lab/closed_loop/moving_arm.hpp"

#include <algorithm>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {

MovingArm::MovingArm(const RobotModel& model, double first_phase)
    : model_(model), phase_s_(first_phase * cycle_s()) {
  for (const std::size_t link : model.evaluated_links) {
    hulls_.push_back(hull_points(model.links[link].mesh_L));
  }
  velocity_rad_s_.assign(model.joints.size(), 0);
  change_rad_s_.assign(model.joints.size(), 0);
  place();
}

double MovingArm::fastest_at(const std::vector<double>& velocity_rad_s) {
  link_twists(model_, pose_, velocity_rad_s, twists_);
  double fastest_m_s = 0;
  for (std::size_t i = 0; i < hulls_.size(); ++i) {
    const std::size_t link = model_.evaluated_links[i];
    fastest_m_s =
        std::max(fastest_m_s, greatest_speed_m_s(hulls_[i], pose_.X_BL[link], twists_[link]));
  }
  return fastest_m_s;
}

void MovingArm::place() {
  plan_ = path_at(phase_s_);
  position_rad_ = plan_.position_rad;
  forward_kinematics(model_, position_rad_, pose_);
  full_m_s_ = fastest_at(plan_.velocity_rad_s);
}

void MovingArm::go_to(double phase_s) {
  phase_s_ = phase_s;
  place();
}

void MovingArm::step(double commanded_share, double step_s) {
  const double before_m_s = share_ * full_m_s_;
  phase_s_ += share_ * step_s;
  place();
  if (full_m_s_ <= 0) {
    share_ = commanded_share;
  } else {
    // The path itself may bend: what is limited is the change of speed.
    const double slowest = (before_m_s - kArmDeceleration_m_s2 * step_s) / full_m_s_;
    const double fastest = (before_m_s + kArmAcceleration_m_s2 * step_s) / full_m_s_;
    share_ = std::clamp(std::clamp(commanded_share, slowest, std::max(slowest, fastest)), 0.0, 1.0);
  }
  for (std::size_t j = 0; j < velocity_rad_s_.size(); ++j) {
    velocity_rad_s_[j] = share_ * plan_.velocity_rad_s[j];
  }
  fastest_m_s_ = fastest_at(velocity_rad_s_);
}

void MovingArm::lead(const std::vector<double>& velocity_rad_s, double step_s) {
  for (std::size_t j = 0; j < velocity_rad_s.size(); ++j) {
    change_rad_s_[j] = velocity_rad_s[j] - velocity_rad_s_[j];
  }
  const double change_m_s = fastest_at(change_rad_s_), most_m_s = kArmDeceleration_m_s2 * step_s;
  const double part = change_m_s > most_m_s ? most_m_s / change_m_s : 1;
  for (std::size_t j = 0; j < velocity_rad_s.size(); ++j) {
    velocity_rad_s_[j] += part * change_rad_s_[j];
  }
  const double gained_m_s = fastest_m_s_ + kArmAcceleration_m_s2 * step_s;
  fastest_m_s_ = fastest_at(velocity_rad_s_);
  const double share = fastest_m_s_ > gained_m_s ? gained_m_s / fastest_m_s_ : 1;
  for (std::size_t j = 0; j < velocity_rad_s.size(); ++j) {
    velocity_rad_s_[j] *= share;
    position_rad_[j] += velocity_rad_s_[j] * step_s;
  }
  fastest_m_s_ *= share;
  forward_kinematics(model_, position_rad_, pose_);
}

}  // namespace berth::lab
