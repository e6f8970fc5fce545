#include "berth/separation/evasion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

/// From the link to what is near it; a unit vector, or zero where the two touch.
Eigen::Vector3d towards(const LinkResult& link) {
  const Eigen::Vector3d way_B = (link.obstacle_point_B_m - link.robot_point_B_m).cast<double>();
  return way_B.norm() > 0 ? Eigen::Vector3d(way_B.normalized()) : Eigen::Vector3d::Zero();
}

/// The mean direction, where it is known and says anything.
Eigen::Vector3d mean_towards(const LinkResult& link) {
  constexpr double kLeastLength = 0.1;
  const Eigen::Vector3d mean_B = link.mean_direction_B.cast<double>();
  return link.mean_count > 0 && mean_B.norm() > kLeastLength ? Eigen::Vector3d(mean_B.normalized())
                                                             : towards(link);
}

}  // namespace

Evader::Evader(std::shared_ptr<const Robot> robot, const std::string& end_effector,
               const EvasionSettings& settings)
    : robot_(std::move(robot)), settings_(settings) {
  visit_settings(settings_, SettingCheck{"evasion"});
  const RobotModel& model = robot_->model();
  const std::vector<std::string> names = model.evaluated_link_names();
  const auto found = std::ranges::find(names, end_effector);
  if (found == names.end()) {
    throw std::invalid_argument(fmt::format("evasion: end effector \"{}\"; expected one of {}",
                                            end_effector, fmt::join(names, ", ")));
  }
  end_effector_ = static_cast<LinkId>(found - names.begin() + 1);
  jacobian_.resize(3, static_cast<Eigen::Index>(model.joints.size()));
  for (auto* numbers : {&out_.velocity, &out_.forward, &out_.backward}) {
    numbers->resize(model.joints.size());
  }
}

double Evader::risk(double distance_m) const {
  const double exponent = (2 * distance_m / settings_.reach_m - 1) * settings_.steepness;
  return 1 / (1 + std::exp(exponent));
}

const Evasion& Evader::update(const Result& result) {
  std::ranges::fill(out_.velocity, 0);
  std::ranges::fill(out_.forward, 1);
  std::ranges::fill(out_.backward, 1);
  for (const LinkResult& link : result.links) {
    if (!link.has_distance() || link.distance_m > settings_.reach_m) continue;
    point_jacobian(robot_->model(), result.pose, robot_->model().evaluated_links[link.id - 1],
                   link.robot_point_B_m.cast<double>(), jacobian_);
    link.id == end_effector_ ? give_way(link) : hold_back(link);
  }
  return out_;
}

void Evader::give_way(const LinkResult& link) {
  const Eigen::Vector3d velocity_B =
      -settings_.max_speed_m_s * risk(link.distance_m) * mean_towards(link);
  const Eigen::Matrix3d damping =
      settings_.damping_m * settings_.damping_m * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d weights =
      (jacobian_ * jacobian_.transpose() + damping).inverse() * velocity_B;
  for (std::size_t j = 0; j < out_.velocity.size(); ++j) {
    out_.velocity[j] = jacobian_.col(static_cast<Eigen::Index>(j)).dot(weights);
  }
}

void Evader::hold_back(const LinkResult& link) {
  const Eigen::Vector3d towards_B = towards(link);
  const double allowed = 1 - risk(link.distance_m);
  for (std::size_t j = 0; j < out_.forward.size(); ++j) {
    const double nearer = jacobian_.col(static_cast<Eigen::Index>(j)).dot(towards_B);
    double& share = nearer > 0 ? out_.forward[j] : out_.backward[j];
    if (nearer != 0) share = std::min(share, allowed);
  }
}

}  // namespace berth
