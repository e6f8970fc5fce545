#include "berth/separation/monitor.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/separation/link_speed.hpp"
#include "berth/separation/near_link.hpp"
#include "berth/separation/path_certificate.hpp"
#include "berth/separation/protective_distance.hpp"

namespace berth {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The greatest scale at now_s, if it gains `per_s` of a second in each; it falls at once. The
/// first time it may be anything, since nobody knows how fast the robot is; where the clock was set
/// back, no more than before.
double most_scale(double now_s, double per_s, SeparationMemory& before) {
  const double passed_s = now_s - before.last_s;
  before.last_s = now_s;
  if (before.is_first) return 1;
  if (!(passed_s > 0)) return before.scale;
  const double risen = before.scale + passed_s * per_s;
  return risen < 1 ? risen : 1;
}

/// The first camera whose images cannot be relied on; -1: none.
int lost_camera(std::span<const CameraResult> cameras) {
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    if (!is_relied_on(cameras[k].status)) return static_cast<int>(k);
  }
  return -1;
}

/// The first camera that does not tell what gives no reading; -1: none.
int untold_camera(std::span<const CameraResult> cameras) {
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    if (is_used(cameras[k].status) && !cameras[k].tells_unread) return static_cast<int>(k);
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

/// Whether everything that the result is made from is in order: then a contact at low speed may be
/// tolerable, else nobody knows how fast it would be.
bool is_healthy(const Result& result) {
  if (result.status != ResultStatus::ok || lost_camera(result.cameras) >= 0) return false;
  return std::ranges::all_of(result.links, [](const LinkResult& link) {
    return !link.is_moved || link.status == LinkStatus::ok ||
           link.status == LinkStatus::none_in_range;
  });
}

/// The memory from update to update, and the steps of one.
struct SeparationMonitor::Parts {
  Parts(std::shared_ptr<const Robot> of, SeparationSettings with);

  const Separation& update(const Result& result, const PlannedMotion& motion, double now_s,
                           const FrameSet* frames);
  /// Where the result leaves nothing to compute, why.
  SeparationReason begin(const Result& result, const PlannedMotion& motion);
  void update_links(const Result& result);
  /// Sets that of each link, and of the robot's fastest point.
  void measure_speeds(const Result& result);
  void update_link(const Result& result, std::size_t i);
  double camera_uncertainty(const Result& result, std::size_t i) const;
  /// How near something is to the link by what the cameras see, without any policy.
  double known_m(const LinkResult& link) const;
  /// Where the formula leaves less than the whole speed, whether the robot's way leaves more.
  void look_along_path(const Result& result, const PlannedMotion& motion, const FrameSet& frames,
                       double most);
  void make_certificate();
  /// How fast the motors let the scale rise; where nobody told what they do, there is no limit.
  double rise_per_s() const;
  void decide(double most);
  /// The scale that a tolerable contact leaves.
  double contact_scale() const;

  std::shared_ptr<const Robot> robot;
  SeparationSettings settings;
  bool holds_sharp = false;
  /// hulls[i] is of the link with the id i + 1.
  std::vector<HullPoints> hulls;
  std::vector<LinkTwist> twists;
  std::vector<PathLink> path_links;
  /// Of its fastest point at full speed, and with what it may gain.
  double planned_m_s = 0;
  double robot_m_s = 0;
  /// What the cameras may miss by their settings.
  double least_detection_m = 0;
  /// The camera that does not tell what gives no reading, and what to do about that.
  int untold = -1;
  UnknownPolicy of_unread = UnknownPolicy::ignore;
  /// SeparationSettings::contact_speed_m_s; 0 where no contact is to be thought of now.
  double contact_m_s = 0;
  /// But the link, which the certificate knows.
  SeparationMemory before;
  /// Null until somebody gives frames.
  std::unique_ptr<PathCertificate> certificate;
  Separation out;
};

SeparationMonitor::SeparationMonitor(std::shared_ptr<const Robot> robot,
                                     SeparationSettings settings)
    : parts_(std::make_unique<Parts>(std::move(robot), std::move(settings))) {}

SeparationMonitor::~SeparationMonitor() = default;
SeparationMonitor::SeparationMonitor(SeparationMonitor&&) noexcept = default;
SeparationMonitor& SeparationMonitor::operator=(SeparationMonitor&&) noexcept = default;

const SeparationSettings& SeparationMonitor::settings() const { return parts_->settings; }

SeparationMemory SeparationMonitor::memory() const {
  SeparationMemory memory = parts_->before;
  if (parts_->certificate) memory.critical_link = parts_->certificate->critical_link();
  return memory;
}

void SeparationMonitor::recall(const SeparationMemory& memory) {
  parts_->before = {memory.is_first, memory.scale, memory.last_s};
  if (memory.critical_link >= 0) parts_->make_certificate();
  if (parts_->certificate) parts_->certificate->begin_with(memory.critical_link);
}

const Separation& SeparationMonitor::update(const Result& result, const PlannedMotion& motion,
                                            double now_s, const FrameSet* frames) {
  return parts_->update(result, motion, now_s, frames);
}

SeparationMonitor::Parts::Parts(std::shared_ptr<const Robot> of, SeparationSettings with)
    : robot(std::move(of)), settings(std::move(with)) {
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
  path_links.resize(hulls.size());
  holds_sharp = std::ranges::any_of(robot->attached(), &Attachment::is_sharp);
}

const Separation& SeparationMonitor::Parts::update(const Result& result,
                                                   const PlannedMotion& motion, double now_s,
                                                   const FrameSet* frames) {
  out.reason = begin(result, motion);
  out.link = kNoLink;
  out.camera = -1;
  out.speed_scale = 0;
  out.basis = SeparationBasis::formula;
  double most = 0;
  if (out.reason == SeparationReason::none) {
    out.speed_scale = 1;
    update_links(result);
    most = most_scale(now_s, rise_per_s(), before);
    if (frames && frames->newest()) look_along_path(result, motion, *frames, most);
  } else {
    most_scale(now_s, 0, before);
  }
  if (out.reason == SeparationReason::no_reading) out.camera = untold;
  decide(most);
  return out;
}

SeparationReason SeparationMonitor::Parts::begin(const Result& result,
                                                 const PlannedMotion& motion) {
  out.reaction_time_s = kNaN;
  for (LinkSeparation& link : out.links) {
    link.speed_m_s = link.distance_m = link.required_m = link.margin_m = kNaN;
    link.speed_scale = link.is_moved ? 0 : 1;
    link.reason = link.is_moved ? SeparationReason::stale : SeparationReason::none;
  }
  if (result.time.status != TimeStatus::ok) return SeparationReason::stale;
  const RobotModel& model = robot->model();
  assert(result.pose.X_BL.size() == model.links.size());
  if (!are_finite(motion.velocity, model.joints.size())) return SeparationReason::velocity;
  out.reaction_time_s = age_s(result) + settings.reaction_time_s;
  link_twists(model, result.pose, motion.velocity, twists);
  return SeparationReason::none;
}

void SeparationMonitor::Parts::update_links(const Result& result) {
  out.camera = settings.camera == UnknownPolicy::ignore ? -1 : lost_camera(result.cameras);
  untold = untold_camera(result.cameras);
  of_unread =
      untold < 0 ? UnknownPolicy::ignore : settings.no_reading.value_or(UnknownPolicy::stop);
  least_detection_m = berth::least_detection_m(result.cameras);
  const bool may_touch = !holds_sharp && is_healthy(result) && of_unread != UnknownPolicy::stop;
  contact_m_s = may_touch ? settings.contact_speed_m_s : 0;
  const LinkSeparation* least = nullptr;
  measure_speeds(result);
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    if (!out.links[i].is_moved) continue;
    update_link(result, i);
    if (!least || allows_less(out.links[i], *least)) least = &out.links[i];
  }
  if (!least || least->speed_scale >= 1) return;
  out.speed_scale = least->speed_scale;
  out.reason = least->reason;
  out.link = least->id;
}

void SeparationMonitor::Parts::measure_speeds(const Result& result) {
  const double gain_m_s = settings.acceleration_m_s2 * settings.reaction_time_s;
  planned_m_s = 0;
  for (std::size_t i = 0; i < out.links.size(); ++i) {
    LinkSeparation& link = out.links[i];
    if (!link.is_moved) continue;
    const std::size_t index = robot->model().evaluated_links[i];
    const double fastest_m_s = greatest_speed_m_s(hulls[i], result.pose.X_BL[index], twists[index]);
    planned_m_s = std::max(planned_m_s, fastest_m_s);
    link.speed_m_s = fastest_m_s + gain_m_s;
  }
  robot_m_s = planned_m_s + gain_m_s;
}

void SeparationMonitor::Parts::update_link(const Result& result, std::size_t i) {
  LinkSeparation& link = out.links[i];
  NearLink near = near_link(settings, result.links[i], robot->settings().distance.range_m);
  near = with_unknown(near, of_unread, settings.assumed_range_m, SeparationReason::no_reading);
  if (out.camera >= 0) {
    near = with_unknown(near, settings.camera, settings.assumed_range_m, SeparationReason::camera);
  }
  const ProtectiveTerms terms{out.reaction_time_s,
                              settings.camera_uncertainty_m.value_or(camera_uncertainty(result, i)),
                              least_detection_m, contact_m_s};
  const LinkSpeed speed{link.speed_m_s, robot_m_s};
  link.distance_m = near.distance_m;
  link.required_m = protective_distance_m(settings, terms, speed);
  link.margin_m = link.distance_m - link.required_m;
  link.speed_scale = greatest_speed_scale(settings, terms, speed, link.distance_m);
  link.reason = link.speed_scale < 1 ? near.reason : SeparationReason::none;
  path_links[i] = {.is_moved = true,
                   .added_m = intrusion_m(settings, least_detection_m) +
                              terms.camera_uncertainty_m + settings.robot_uncertainty_m,
                   .known_m = known_m(result.links[i]),
                   .assumed_m = near.distance_m};
}

double SeparationMonitor::Parts::known_m(const LinkResult& link) const {
  const bool ignores = settings.unknown == UnknownPolicy::ignore;
  const float bound_m = ignores ? link.occupied.lower_bound_m : link.lower_bound_m;
  return std::isnan(bound_m) ? 0 : bound_m;
}

void SeparationMonitor::Parts::look_along_path(const Result& result, const PlannedMotion& motion,
                                               const FrameSet& frames, double most) {
  const double formula = out.speed_scale;
  if (formula >= most) return;
  make_certificate();
  const double oldest_s = out.reaction_time_s - settings.reaction_time_s;
  const double joints_s = std::isfinite(result.time.joints_age_s) ? result.time.joints_age_s : 0;
  const PathScale found = certificate->greatest_scale(
      {.pose = result.pose,
       .motion = motion,
       .space = frames.space(),
       .undecided = &frames.undecided(),
       .reaction_time_s = out.reaction_time_s,
       .travel_time_s = settings.reaction_time_s + std::clamp(joints_s, 0.0, oldest_s),
       .planned_m_s = planned_m_s,
       .robot_m_s = robot_m_s,
       .contact_m_s = contact_m_s,
       .links = path_links},
      formula, before.scale, most);
  if (!(found.scale > formula)) return;
  out.basis = SeparationBasis::path;
  out.speed_scale = found.scale;
  for (LinkSeparation& link : out.links) {
    link.speed_scale = std::max(link.speed_scale, found.scale);
    if (link.speed_scale >= 1) link.reason = SeparationReason::none;
  }
  if (found.link < 0) return;
  const LinkSeparation& link = out.links[static_cast<std::size_t>(found.link)];
  out.link = link.id;
  out.reason = link.reason == SeparationReason::none ? SeparationReason::occupied : link.reason;
}

void SeparationMonitor::Parts::make_certificate() {
  if (!certificate) certificate = std::make_unique<PathCertificate>(robot, settings, hulls);
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

double SeparationMonitor::Parts::rise_per_s() const {
  const bool is_limited = settings.acceleration_m_s2 > 0 && robot_m_s > 0;
  return is_limited ? settings.acceleration_m_s2 / robot_m_s : std::numeric_limits<double>::max();
}

double SeparationMonitor::Parts::contact_scale() const {
  if (contact_m_s <= 0) return 0;
  return robot_m_s > contact_m_s ? contact_m_s / robot_m_s : 1;
}

void SeparationMonitor::Parts::decide(double most) {
  if (most < out.speed_scale) {
    out.reason = SeparationReason::speeding_up;
    out.link = kNoLink;
    out.speed_scale = most;
  }
  const double contact = most > 0 ? std::min(contact_scale(), most) : 0;
  const bool is_contact = out.speed_scale < contact;
  out.speed_scale = std::max(out.speed_scale, contact);
  before.scale = out.speed_scale;
  before.is_first = false;
  if (!is_contact && out.speed_scale < kLeastScale) out.speed_scale = 0;
  out.state = is_contact             ? SeparationState::contact_speed
              : out.speed_scale >= 1 ? SeparationState::clear
              : out.speed_scale > 0  ? SeparationState::reduced
                                     : SeparationState::stop;
}

}  // namespace berth
