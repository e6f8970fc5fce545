#include "berth/separation/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "berth/separation/camera_uncertainty.hpp"
#include "berth/separation/near_link.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool are_finite(std::span<const double> values, std::size_t count) {
  return values.size() == count &&
         std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// The first camera whose images cannot be relied on; -1: none.
int lost_camera(std::span<const CameraState> cameras) {
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const CameraStatus status = cameras[k].status;
    if (!is_used(status) || status == CameraStatus::blind) return static_cast<int>(k);
  }
  return -1;
}

/// Of the oldest thing that the answer is made from; 0 where nobody told the time.
double age_s(const SeparationQuestion& question) {
  double oldest_s = 0;
  const auto look = [&](double age_s) {
    if (age_s > oldest_s) oldest_s = age_s;
  };
  for (const CameraState& camera : question.cameras) {
    if (is_used(camera.status)) look(camera.age_s);
  }
  look(question.answer.time.frame_age_s);
  look(question.answer.time.joints_age_s);
  return oldest_s;
}

bool allows_less(const LinkSeparation& a, const LinkSeparation& b) {
  return a.speed_scale != b.speed_scale ? a.speed_scale < b.speed_scale : a.margin_m < b.margin_m;
}

}  // namespace

SeparationMonitor::SeparationMonitor(std::shared_ptr<const Robot> robot,
                                     SeparationSettings settings)
    : robot_(std::move(robot)), settings_(std::move(settings)), hold_(settings_.hold_s) {
  validate(settings_);
  if (!robot_->settings().visibility) {
    throw std::invalid_argument(
        "separation: visibility is off; expected on, since it tells which links are seen");
  }
  const RobotModel& model = robot_->model();
  for (const std::size_t index : model.evaluated_links) {
    hulls_.push_back(hull_points(model.links[index].mesh_L));
    LinkSeparation& link = out_.links.emplace_back();
    link.id = model.links[index].id;
    link.is_moved = model.is_moved(index);
  }
  position_.resize(model.joints.size());
  pose_.X_BL.resize(model.links.size());
  twists_.resize(model.links.size());
}

const Separation& SeparationMonitor::look(const SeparationQuestion& question) {
  out_.reason = begin(question);
  out_.link = kNoLink;
  out_.camera = -1;
  out_.speed_scale = rising_scale_ = 0;
  if (out_.reason == SeparationReason::none) {
    out_.speed_scale = rising_scale_ = 1;
    look_at_links(question);
  }
  decide(question.now_s);
  return out_;
}

SeparationReason SeparationMonitor::begin(const SeparationQuestion& question) {
  out_.reaction_time_s = kNaN;
  for (LinkSeparation& link : out_.links) {
    link.speed_m_s = link.distance_m = link.required_m = link.margin_m = kNaN;
    link.speed_scale = link.is_moved ? 0 : 1;
    link.reason = link.is_moved ? SeparationReason::untimely : SeparationReason::none;
  }
  if (question.answer.time.status != TimeStatus::ok) return SeparationReason::untimely;
  const RobotModel& model = robot_->model();
  if (!are_finite(question.position, model.joints.size()) ||
      !are_finite(question.velocity, model.joints.size())) {
    return SeparationReason::velocity;
  }
  out_.reaction_time_s = age_s(question) + settings_.reaction_time_s;
  std::ranges::copy(question.position, position_.begin());
  forward_kinematics(model, position_, pose_);
  link_twists(model, pose_, question.velocity, twists_);
  return SeparationReason::none;
}

void SeparationMonitor::look_at_links(const SeparationQuestion& question) {
  out_.camera = settings_.camera == UnknownPolicy::ignore ? -1 : lost_camera(question.cameras);
  const LinkSeparation* least = nullptr;
  const double robot_m_s = measure_speeds(question);
  for (std::size_t i = 0; i < out_.links.size(); ++i) {
    if (!out_.links[i].is_moved) continue;
    look_at(question, robot_m_s, i);
    if (!least || allows_less(out_.links[i], *least)) least = &out_.links[i];
  }
  if (!least || least->speed_scale >= 1) return;
  out_.speed_scale = least->speed_scale;
  out_.reason = least->reason;
  out_.link = least->id;
}

double SeparationMonitor::measure_speeds(const SeparationQuestion& question) {
  const double gain_m_s = settings_.acceleration_m_s2 * settings_.reaction_time_s;
  double robot_m_s = 0;
  for (std::size_t i = 0; i < out_.links.size(); ++i) {
    LinkSeparation& link = out_.links[i];
    if (!link.is_moved) continue;
    const std::size_t index = robot_->model().evaluated_links[i];
    const double fastest_m_s = greatest_speed_m_s(hulls_[i], pose_.X_BL[index], twists_[index]);
    robot_m_s = std::max(robot_m_s, fastest_m_s + gain_m_s);
    link.speed_m_s = speed_towards(question, i).value_or(fastest_m_s) + gain_m_s;
  }
  return robot_m_s;
}

void SeparationMonitor::look_at(const SeparationQuestion& question, double robot_m_s,
                                std::size_t i) {
  LinkSeparation& out = out_.links[i];
  const LinkVisibility none;
  const auto& visibility = question.answer.visibility;
  NearLink near =
      near_link(settings_, question.answer.distances.links[i],
                i < visibility.size() ? visibility[i] : none, robot_->settings().distance.range_m);
  if (out_.camera >= 0) {
    near =
        with_unknown(near, settings_.camera, settings_.assumed_range_m, SeparationReason::camera);
  }
  const ProtectiveTerms terms{out_.reaction_time_s, settings_.camera_uncertainty_m.value_or(
                                                        camera_uncertainty(question, i))};
  const LinkSpeed speed{out.speed_m_s, robot_m_s};
  out.distance_m = near.distance_m;
  out.required_m = protective_distance_m(settings_, terms, speed);
  out.margin_m = out.distance_m - out.required_m;
  out.speed_scale = greatest_speed_scale(settings_, terms, speed, out.distance_m);
  out.reason = out.speed_scale < 1 ? near.reason : SeparationReason::none;
  rising_scale_ = greatest_speed_scale(settings_, terms, speed,
                                       out.distance_m - settings_.release_m, rising_scale_);
}

std::optional<double> SeparationMonitor::speed_towards(const SeparationQuestion& question,
                                                       std::size_t i) const {
  if (!settings_.directed_speed) return {};
  const std::size_t index = robot_->model().evaluated_links[i];
  const LinkDistance& link = question.answer.distances.links[i];
  const Eigen::Vector3d way_B = (link.obstacle_point_B_m - link.robot_point_B_m).cast<double>();
  // NaN where there is no pair in the base frame, 0 where they touch.
  if (!(way_B.norm() > 0)) return {};
  return greatest_speed_along_m_s(hulls_[i], pose_.X_BL[index], twists_[index], way_B.normalized());
}

double SeparationMonitor::camera_uncertainty(const SeparationQuestion& question,
                                             std::size_t i) const {
  const LinkDistance& link = question.answer.distances.links[i];
  const bool has_point = link.obstacle_point_B_m.allFinite();
  const Eigen::Vector3d p_B =
      has_point ? Eigen::Vector3d(link.obstacle_point_B_m.cast<double>())
                : Eigen::Vector3d(pose_.X_BL[robot_->model().evaluated_links[i]].translation());
  double greatest_m = 0;
  for (std::size_t k = 0; k < question.frames.size(); ++k) {
    const Frame* frame = question.frames[k].get();
    if (!frame || !frame->view || !is_used(question.cameras[k].status)) continue;
    const double depth_m = (frame->X_BC.inverse() * p_B).z();
    greatest_m =
        std::max(greatest_m, camera_uncertainty_m(frame->view->settings(), link.id, depth_m));
  }
  return greatest_m;
}

void SeparationMonitor::decide(double now_s) {
  const double held = hold_.next(out_.speed_scale, rising_scale_, now_s);
  if (held < out_.speed_scale) {
    out_.reason = SeparationReason::hold;
    out_.link = kNoLink;
  }
  out_.speed_scale = held < settings_.least_scale ? 0 : held;
  out_.state = out_.speed_scale >= 1  ? SeparationState::clear
               : out_.speed_scale > 0 ? SeparationState::reduced
                                      : SeparationState::stop;
}

}  // namespace berth
