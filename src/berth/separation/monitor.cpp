#include "berth/separation/monitor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/separation/camera_uncertainty.hpp"
#include "berth/separation/link_speed.hpp"
#include "berth/separation/near_link.hpp"
#include "berth/separation/protective_distance.hpp"
#include "berth/separation/speed_hold.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool are_finite(std::span<const double> values, std::size_t count) {
  return values.size() == count &&
         std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// The first camera whose images cannot be relied on; -1: none.
int lost_camera(std::span<const CameraResult> cameras) {
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    if (!is_relied_on(cameras[k].status)) return static_cast<int>(k);
  }
  return -1;
}

/// Of the oldest thing that the result is made from; 0 where nobody told the time.
double age_s(const Result& result) {
  double oldest_s = 0;
  const auto take = [&](double age_s) {
    if (age_s > oldest_s) oldest_s = age_s;
  };
  for (const CameraResult& camera : result.cameras) {
    if (is_used(camera.status)) take(camera.age_s);
  }
  take(result.time.frame_age_s);
  take(result.time.joints_age_s);
  return oldest_s;
}

bool allows_less(const LinkSeparation& a, const LinkSeparation& b) {
  return a.speed_scale != b.speed_scale ? a.speed_scale < b.speed_scale : a.margin_m < b.margin_m;
}

}  // namespace

/// What is kept from update to update, and the steps of one.
struct SeparationMonitor::Parts {
  Parts(std::shared_ptr<const Robot> of, SeparationSettings with);

  const Separation& update(const Result& result, std::span<const double> velocity, double now_s);
  /// Where the result leaves nothing to compute, why.
  SeparationReason begin(const Result& result, std::span<const double> velocity);
  void update_links(const Result& result);
  /// Sets that of each link; that of the robot's fastest point.
  double measure_speeds(const Result& result);
  /// Towards the closest obstacle, where that is what counts.
  std::optional<double> speed_towards(const Result& result, std::size_t i) const;
  void update_link(const Result& result, double robot_m_s, std::size_t i);
  double camera_uncertainty(const Result& result, std::size_t i) const;
  void decide(double now_s);

  std::shared_ptr<const Robot> robot;
  SeparationSettings settings;
  /// hulls[i] is of the link with the id i + 1.
  std::vector<HullPoints> hulls;
  std::vector<LinkTwist> twists;
  /// Of the link that has least room, with release_m to spare.
  double rising_scale = 0;
  SpeedHold hold;
  Separation out;
};

SeparationMonitor::SeparationMonitor(std::shared_ptr<const Robot> robot,
                                     SeparationSettings settings)
    : parts_(std::make_unique<Parts>(std::move(robot), std::move(settings))) {}

SeparationMonitor::~SeparationMonitor() = default;
SeparationMonitor::SeparationMonitor(SeparationMonitor&&) noexcept = default;
SeparationMonitor& SeparationMonitor::operator=(SeparationMonitor&&) noexcept = default;

const SeparationSettings& SeparationMonitor::settings() const { return parts_->settings; }

const Separation& SeparationMonitor::update(const Result& result, std::span<const double> velocity,
                                            double now_s) {
  return parts_->update(result, velocity, now_s);
}

SeparationMonitor::Parts::Parts(std::shared_ptr<const Robot> of, SeparationSettings with)
    : robot(std::move(of)), settings(std::move(with)), hold(settings.hold_s) {
  validate(settings);
  if (!robot->settings().visibility) {
    throw std::invalid_argument(
        "separation: visibility is off; expected on, since it tells which links are seen");
  }
  const RobotModel& model = robot->model();
  for (const std::size_t index : model.evaluated_links) {
    hulls.push_back(hull_points(model.links[index].mesh_L));
    LinkSeparation& link = out.links.emplace_back();
    link.id = model.links[index].id;
    link.is_moved = model.is_moved(index);
  }
  twists.resize(model.links.size());
}

const Separation& SeparationMonitor::Parts::update(const Result& result,
                                                   std::span<const double> velocity, double now_s) {
  out.reason = begin(result, velocity);
  out.link = kNoLink;
  out.camera = -1;
  out.speed_scale = rising_scale = 0;
  if (out.reason == SeparationReason::none) {
    out.speed_scale = rising_scale = 1;
    update_links(result);
  }
  decide(now_s);
  return out;
}

SeparationReason SeparationMonitor::Parts::begin(const Result& result,
                                                 std::span<const double> velocity) {
  out.reaction_time_s = kNaN;
  for (LinkSeparation& link : out.links) {
    link.speed_m_s = link.distance_m = link.required_m = link.margin_m = kNaN;
    link.speed_scale = link.is_moved ? 0 : 1;
    link.reason = link.is_moved ? SeparationReason::stale : SeparationReason::none;
  }
  if (result.time.status != TimeStatus::ok) return SeparationReason::stale;
  const RobotModel& model = robot->model();
  assert(result.pose.X_BL.size() == model.links.size());
  if (!are_finite(velocity, model.joints.size())) return SeparationReason::velocity;
  out.reaction_time_s = age_s(result) + settings.reaction_time_s;
  link_twists(model, result.pose, velocity, twists);
  return SeparationReason::none;
}

void SeparationMonitor::Parts::update_links(const Result& result) {
  out.camera = settings.camera == UnknownPolicy::ignore ? -1 : lost_camera(result.cameras);
  const LinkSeparation* least = nullptr;
  const double robot_m_s = measure_speeds(result);
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    if (!out.links[i].is_moved) continue;
    update_link(result, robot_m_s, i);
    if (!least || allows_less(out.links[i], *least)) least = &out.links[i];
  }
  if (!least || least->speed_scale >= 1) return;
  out.speed_scale = least->speed_scale;
  out.reason = least->reason;
  out.link = least->id;
}

double SeparationMonitor::Parts::measure_speeds(const Result& result) {
  const double gain_m_s = settings.acceleration_m_s2 * settings.reaction_time_s;
  double robot_m_s = 0;
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    LinkSeparation& link = out.links[i];
    if (!link.is_moved) continue;
    const std::size_t index = robot->model().evaluated_links[i];
    const double fastest_m_s = greatest_speed_m_s(hulls[i], result.pose.X_BL[index], twists[index]);
    robot_m_s = std::max(robot_m_s, fastest_m_s + gain_m_s);
    link.speed_m_s = speed_towards(result, i).value_or(fastest_m_s) + gain_m_s;
  }
  return robot_m_s;
}

void SeparationMonitor::Parts::update_link(const Result& result, double robot_m_s, std::size_t i) {
  LinkSeparation& link = out.links[i];
  NearLink near = near_link(settings, result.links[i], robot->settings().distance.range_m);
  if (out.camera >= 0) {
    near = with_unknown(near, settings.camera, settings.assumed_range_m, SeparationReason::camera);
  }
  const ProtectiveTerms terms{
      out.reaction_time_s, settings.camera_uncertainty_m.value_or(camera_uncertainty(result, i))};
  const LinkSpeed speed{link.speed_m_s, robot_m_s};
  link.distance_m = near.distance_m;
  link.required_m = protective_distance_m(settings, terms, speed);
  link.margin_m = link.distance_m - link.required_m;
  link.speed_scale = greatest_speed_scale(settings, terms, speed, link.distance_m);
  link.reason = link.speed_scale < 1 ? near.reason : SeparationReason::none;
  rising_scale = greatest_speed_scale(settings, terms, speed, link.distance_m - settings.release_m,
                                      rising_scale);
}

std::optional<double> SeparationMonitor::Parts::speed_towards(const Result& result,
                                                              std::size_t i) const {
  if (!settings.directed_speed) return {};
  const std::size_t index = robot->model().evaluated_links[i];
  const LinkResult& link = result.links[i];
  const Eigen::Vector3d way_B = (link.obstacle_point_B_m - link.robot_point_B_m).cast<double>();
  // NaN where there is no pair in the base frame, 0 where they touch.
  if (!(way_B.norm() > 0)) return {};
  return greatest_speed_along_m_s(hulls[i], result.pose.X_BL[index], twists[index],
                                  way_B.normalized());
}

double SeparationMonitor::Parts::camera_uncertainty(const Result& result, std::size_t i) const {
  const LinkResult& link = result.links[i];
  const bool has_point = link.obstacle_point_B_m.allFinite();
  const Eigen::Vector3d p_B =
      has_point
          ? Eigen::Vector3d(link.obstacle_point_B_m.cast<double>())
          : Eigen::Vector3d(result.pose.X_BL[robot->model().evaluated_links[i]].translation());
  double greatest_m = 0;
  for (const CameraResult& camera : result.cameras) {
    if (!camera.mounted || !is_used(camera.status)) continue;
    const double depth_m = (camera.X_BC.inverse() * p_B).z();
    greatest_m =
        std::max(greatest_m, camera_uncertainty_m(camera.mounted->settings(), link.id, depth_m));
  }
  return greatest_m;
}

void SeparationMonitor::Parts::decide(double now_s) {
  const double held = hold.next(out.speed_scale, rising_scale, now_s);
  if (held < out.speed_scale) {
    out.reason = SeparationReason::hold;
    out.link = kNoLink;
  }
  out.speed_scale = held < settings.least_scale ? 0 : held;
  out.state = out.speed_scale >= 1  ? SeparationState::clear
              : out.speed_scale > 0 ? SeparationState::reduced
                                    : SeparationState::stop;
}

}  // namespace berth
