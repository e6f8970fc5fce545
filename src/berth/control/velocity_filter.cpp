#include "berth/control/velocity_filter.hpp"

#include <algorithm>
#include <cmath>

#include "berth/control/half_spaces.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// What one row says of a link.
struct VelocityFilter::Bound {
  LinkRow row;
  double lower_bound_m = 0;
  /// Its half-space; none where no pair gives a direction.
  std::optional<Eigen::Index> half_space;
};

VelocityFilter::VelocityFilter(std::shared_ptr<const Robot> robot,
                               const VelocityFilterSettings& settings,
                               const std::vector<std::size_t>& others)
    : robot_(std::move(robot)),
      settings_(settings),
      rows_(robot_),
      is_of_others_(robot_->model().joints.size(), false) {
  visit_settings(settings_, SettingCheck{"velocity_filter"});
  for (const std::size_t joint : others) is_of_others_.at(joint) = true;
  const auto joints = static_cast<Eigen::Index>(robot_->model().joints.size());
  const std::size_t pairs = kRowKinds.size() + robot_->settings().candidates - 1;
  const std::size_t most_rows = pairs * robot_->model().evaluated_links.size();
  spaces_ = std::make_unique<HalfSpaces>(joints, 2 * joints + static_cast<Eigen::Index>(most_rows));
  bounds_.reserve(most_rows);
  out_.held_by.reserve(most_rows);
  out_.velocity.resize(static_cast<std::size_t>(joints));
  for (auto* of_joints :
       {&lower_, &upper_, &before_, &planned_, &speed_, &normal_, &weight_, &weighted_}) {
    of_joints->setZero(joints);
  }
}

VelocityFilter::~VelocityFilter() = default;

const FilteredVelocity& VelocityFilter::update(const Result& result, const JointMotion& joints) {
  std::ranges::fill(out_.velocity, 0.0);
  out_.held_by.clear();
  out_.scale = 0;
  rows_.update(result);
  if (result.status == ResultStatus::stale) {
    out_.status = FilterStatus::stale;
  } else if (!are_good(joints)) {
    out_.status = FilterStatus::bad_joints;
  } else if (settings_.stop_unseen && !is_all_seen(result)) {
    out_.status = FilterStatus::unseen;
  } else if (!find_bounds(result)) {
    out_.status = FilterStatus::contact;
  } else {
    find_limits(joints);
    solve(joints);
  }
  return out_;
}

bool VelocityFilter::are_good(const JointMotion& joints) const {
  const std::size_t count = out_.velocity.size();
  const bool are_weights_good =
      joints.weight.empty() ||
      (are_finite(joints.weight, count) &&
       std::ranges::all_of(joints.weight, [](double weight) { return weight > 0; }));
  return are_weights_good && are_finite(joints.position, count) &&
         are_finite(joints.velocity, count) && are_finite(joints.wanted, count);
}

bool VelocityFilter::is_all_seen(const Result& result) {
  for (const LinkResult& link : result.links) {
    const bool is_seen = link.status == LinkStatus::ok ||
                         link.status == LinkStatus::none_in_range ||
                         link.status == LinkStatus::cut_short;
    if (link.is_moved && !is_seen) out_.held_by.push_back({link.id, RowKind::nearest});
  }
  return out_.held_by.empty() && result.status == ResultStatus::ok;
}

void VelocityFilter::find_limits(const JointMotion& joints) {
  const double gain = settings_.max_acceleration * settings_.period_s;
  // As fast as the room to a limit allows: not beyond it in a period, and so that it can stop.
  const auto most = [&](double room, double max_speed) {
    if (!(room > 0)) return 0.0;
    const double speed =
        std::min(room / settings_.period_s, std::sqrt(2 * settings_.max_acceleration * room));
    return max_speed > 0 ? std::min(speed, max_speed) : speed;
  };
  for (std::size_t j = 0; j < out_.velocity.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    before_[at] = std::abs(joints.velocity[j]);
    if (is_of_others_[j]) {
      lower_[at] = upper_[at] = planned_[at] = 0;
      continue;
    }
    const MovableJoint& joint = robot_->model().joints[j];
    const double velocity = joints.velocity[j];
    const double position = joints.position[j] + settings_.latency_s * velocity;
    const double least = -most(position - joint.lower, joint.max_speed);
    const double greatest = most(joint.upper - position, joint.max_speed);
    // A limit of position or speed goes before that of the acceleration.
    lower_[at] = std::clamp(velocity - gain, least, greatest);
    upper_[at] = std::clamp(velocity + gain, least, greatest);
    planned_[at] = std::abs(std::clamp(joints.wanted[j], least, greatest));
  }
}

bool VelocityFilter::find_bounds(const Result& result) {
  bounds_.clear();
  for (const LinkResult& link : result.links) {
    if (!link.is_moved) continue;
    const bool is_same = link.occupied.obstacle_point_B_m == link.obstacle_point_B_m;
    for (const RowKind kind : kRowKinds) {
      if (kind == RowKind::occupied && (!link.occupied.is_known() || is_same)) continue;
      const double lower_bound_m = kind == RowKind::nearest    ? link.lower_bound_m
                                   : kind == RowKind::occupied ? link.occupied.lower_bound_m
                                                               : link.known.lower_bound_m;
      // Nothing is asked about this link.
      if (kind == RowKind::known && std::isnan(lower_bound_m)) continue;
      bounds_.push_back({{link.id, kind}, lower_bound_m, {}});
      if (!(lower_bound_m > 0)) out_.held_by.push_back({link.id, kind});
    }
    for (std::size_t k = 0; k < link.candidates.size(); ++k) {
      // Nothing is nearer than the link's own bound says.
      const double lower_bound_m = std::fmax(link.candidates[k].lower_bound_m, link.lower_bound_m);
      bounds_.push_back({{link.id, RowKind::nearest, static_cast<int>(k + 1)}, lower_bound_m, {}});
    }
  }
  return out_.held_by.empty();
}

double VelocityFilter::speed_m_s(const LinkRow& row, const Eigen::VectorXd& joints) const {
  return rows_.reach_m(row.kind).row(row.link - 1).dot(joints);
}

void VelocityFilter::add_half_spaces() {
  spaces_->clear();
  for (Eigen::Index j = 0; j < lower_.size(); ++j) {
    normal_.setZero();
    normal_[j] = 1;
    if (std::isfinite(lower_[j])) add_half_space(lower_[j]);
    normal_[j] = -1;
    if (std::isfinite(upper_[j])) add_half_space(-upper_[j]);
  }
  for (Bound& bound : bounds_) {
    normal_ = rows_.gradient(bound.row.kind, bound.row.candidate).row(bound.row.link - 1);
    if (!normal_.allFinite()) continue;
    // What the check below asks for: without it the robot would come so near that it creeps.
    const double checked_m =
        (settings_.period_s + settings_.latency_s) * speed_m_s(bound.row, planned_);
    const double room_m = bound.lower_bound_m - settings_.least_distance_m - checked_m;
    bound.half_space = add_half_space(-settings_.approach_rate_1_s * std::max(0.0, room_m));
  }
}

/// normal_ . v >= bound, in the space of velocities by their weights.
Eigen::Index VelocityFilter::add_half_space(double bound) {
  weighted_ = normal_.cwiseQuotient(weight_);
  return spaces_->add(weighted_, bound);
}

void VelocityFilter::solve(const JointMotion& joints) {
  if (joints.weight.empty()) weight_.setOnes();
  if (!joints.weight.empty()) weight_ = Vector(joints.weight.data(), std::ssize(joints.weight));
  add_half_spaces();
  weighted_ = Vector(joints.wanted.data(), std::ssize(joints.wanted)).cwiseProduct(weight_);
  const bool is_solved = spaces_->project(weighted_);
  for (const Bound& bound : bounds_) {
    const bool holds =
        bound.half_space && spaces_->weights()[*bound.half_space] > HalfSpaces::kTolerance;
    if (holds) out_.held_by.push_back(bound.row);
  }
  out_.status = is_solved ? FilterStatus::ok : FilterStatus::no_solution;
  if (is_solved) shorten();
}

void VelocityFilter::shorten() {
  weighted_ = spaces_->point().cwiseQuotient(weight_);
  speed_ = weighted_.cwiseAbs();
  const double all_s = settings_.period_s + settings_.latency_s;
  double scale = 1;
  const Bound* shortest = nullptr;
  for (const Bound& bound : bounds_) {
    const double speed_m_s = this->speed_m_s(bound.row, speed_);
    if (!(speed_m_s > 0)) continue;
    // What is too near already must be left, and is not to be touched meanwhile.
    const bool is_too_near = bound.lower_bound_m < settings_.least_distance_m;
    const double least_m = is_too_near ? bound.lower_bound_m / 2 : settings_.least_distance_m;
    const double room_m = bound.lower_bound_m - least_m;
    const double left_m = room_m - settings_.latency_s * this->speed_m_s(bound.row, before_);
    // The second: else a robot that is late would stop and go.
    const double most = std::max(
        0.0, std::min(left_m / (settings_.period_s * speed_m_s), room_m / (all_s * speed_m_s)));
    if (most >= scale) continue;
    scale = most;
    shortest = &bound;
  }
  out_.scale = scale;
  Eigen::Map<Eigen::VectorXd>(out_.velocity.data(), speed_.size()) = scale * weighted_;
  const bool is_new = shortest && std::ranges::none_of(out_.held_by, [&](const LinkRow& row) {
                        return row == shortest->row;
                      });
  if (is_new) out_.held_by.push_back(shortest->row);
}

}  // namespace berth
