#include "lab/closed_loop/moving_arm.hpp"

#include <algorithm>

#include "lab/closed_loop/cell.hpp"

namespace berth::lab {
namespace {

/// What the arm may do beside its path.
constexpr double kMostAside_rad = 0.8, kAside_rad_s2 = 8;

}  // namespace

MovingArm::MovingArm(const RobotModel& model, double first_phase)
    : model_(model), phase_s_(first_phase * cycle_s()) {
  for (const std::size_t link : model.evaluated_links) {
    hulls_.push_back(hull_points(model.links[link].mesh_L));
  }
  aside_rad_.assign(model.joints.size(), 0);
  aside_rad_s_.assign(model.joints.size(), 0);
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
  for (std::size_t j = 0; j < position_rad_.size(); ++j) position_rad_[j] += aside_rad_[j];
  forward_kinematics(model_, position_rad_, pose_);
  full_m_s_ = fastest_at(plan_.velocity_rad_s);
}

void MovingArm::go_aside(double step_s, const std::vector<double>& velocity_rad_s) {
  for (std::size_t j = 0; j < aside_rad_.size(); ++j) {
    const double wanted = velocity_rad_s[j] - share_ * plan_.velocity_rad_s[j];
    const double change = kAside_rad_s2 * step_s;
    aside_rad_s_[j] += std::clamp(wanted - aside_rad_s_[j], -change, change);
    aside_rad_[j] =
        std::clamp(aside_rad_[j] + aside_rad_s_[j] * step_s, -kMostAside_rad, kMostAside_rad);
  }
}

void MovingArm::step(double commanded_share, double step_s,
                     const std::vector<double>* velocity_rad_s) {
  const double before_m_s = share_ * full_m_s_;
  phase_s_ += share_ * step_s;
  if (velocity_rad_s) go_aside(step_s, *velocity_rad_s);
  place();
  if (full_m_s_ <= 0) {
    share_ = commanded_share;
  } else {
    // The path itself may bend: what is limited is the change of speed.
    const double slowest = (before_m_s - kArmDeceleration_m_s2 * step_s) / full_m_s_;
    const double fastest = (before_m_s + kArmAcceleration_m_s2 * step_s) / full_m_s_;
    share_ = std::clamp(std::clamp(commanded_share, slowest, std::max(slowest, fastest)), 0.0, 1.0);
  }
  std::vector<double> all_rad_s = aside_rad_s_;
  for (std::size_t j = 0; j < all_rad_s.size(); ++j) {
    all_rad_s[j] += share_ * plan_.velocity_rad_s[j];
  }
  fastest_m_s_ = fastest_at(all_rad_s);
}

}  // namespace berth::lab
