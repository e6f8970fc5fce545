#include "berth/control/distance_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "berth/distance/known_model.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/plausible_size.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PointsOfPair points_of(const LinkResult& link, RowKind kind, int candidate) {
  if (candidate > 0) {
    const auto place = static_cast<std::size_t>(candidate - 1);
    return place < link.candidates.size() ? points_of(link.candidates[place]) : PointsOfPair();
  }
  if (kind == RowKind::known) return points_of(link.known);
  return points_of(kind == RowKind::nearest ? link : link.occupied);
}

/// As the robot stands with all joints at 0.
RobotPose pose_at_zero(const RobotModel& model) {
  RobotPose pose;
  forward_kinematics(model, std::vector<double>(model.joints.size(), 0.0), pose);
  return pose;
}

}  // namespace

DistanceRows::DistanceRows(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), of_pair_(robot_->model()) {
  const RobotModel& model = robot_->model();
  const auto links = static_cast<Eigen::Index>(model.evaluated_links.size());
  const auto joints = static_cast<Eigen::Index>(model.joints.size());
  const std::size_t pairs = kRowKinds.size() + robot_->settings().candidates - 1;
  gradients_.assign(pairs, LinksByJoints::Constant(links, joints, kNaN));
  normals_B_.assign(pairs, LinkVectors::Constant(links, 3, kNaN));
  reach_m_.resize(links, joints);
  known_reach_m_.resize(links, joints);
  sum_m_.resize(joints);
  for (const KnownBody& body : robot_->known().bodies) {
    chains_.push_back(joint_chain(model, body.link));
    radius_m_.push_back(berth::reach_m(model.links[body.link].mesh_L));
  }
  has_slides_ = std::ranges::any_of(
      model.links, [](const Link& link) { return link.joint.type == JointType::prismatic; });
  find_reaches(pose_at_zero(model));
}

DistanceRows::~DistanceRows() = default;

std::size_t DistanceRows::index(RowKind kind, int candidate) const {
  if (candidate == 0) return static_cast<std::size_t>(kind);
  const int last = kind == RowKind::nearest ? robot_->settings().candidates - 1 : 0;
  if (candidate < 0 || candidate > last) {
    throw std::out_of_range(
        fmt::format("candidate: {}; expected 0 to {} for {}", candidate, last, name_of(kind)));
  }
  return kRowKinds.size() + static_cast<std::size_t>(candidate - 1);
}

void DistanceRows::update(const Result& result) {
  const auto links = static_cast<std::size_t>(reach_m_.rows());
  if (result.links.size() != links) {
    throw std::invalid_argument(fmt::format("result: {} links; expected {}, those of robot \"{}\"",
                                            result.links.size(), links, robot_->model().name));
  }
  for (LinksByJoints& gradient : gradients_) gradient.setConstant(kNaN);
  for (std::size_t i = 0; i < links; ++i) {
    for (const RowKind kind : kRowKinds) differentiate(result, i, kind, 0);
    for (int candidate = 1; candidate < robot_->settings().candidates; ++candidate) {
      differentiate(result, i, RowKind::nearest, candidate);
    }
  }
  if (has_slides_ && !result.pose.X_BL.empty()) find_reaches(result.pose);
}

void DistanceRows::differentiate(const Result& result, std::size_t link, RowKind kind,
                                 int candidate) {
  const PointsOfPair pair = points_of(result.links[link], kind, candidate);
  auto normal_B = normals_B_[index(kind, candidate)].row(static_cast<Eigen::Index>(link));
  if (!pair.is_known || result.pose.X_BL.empty()) {
    normal_B.setConstant(kNaN);
    return;
  }
  auto gradient = gradients_[index(kind, candidate)].row(static_cast<Eigen::Index>(link));
  gradient = of_pair_.find(result.pose, robot_->model().evaluated_links[link], pair);
  if (of_pair_.normal_B() != Eigen::Vector3d::Zero()) normal_B = of_pair_.normal_B().transpose();
}

void DistanceRows::find_reaches(const RobotPose& pose) {
  for (std::size_t i = 0; i < chains_.size(); ++i) {
    find_reach(robot_->model(), pose, radius_m_[i], {}, chains_[i]);
  }
  for (Eigen::Index i = 0; i < reach_m_.rows(); ++i) {
    sum_m_.setZero();
    add_reach(static_cast<std::size_t>(i), 0, sum_m_);
    reach_m_.row(i) = sum_m_.transpose();
  }
  known_reach_m_.setZero();
  for (const auto& [a, b] : robot_->known().pairs) {
    const std::size_t common = common_joints(a, b);
    sum_m_.setZero();
    add_reach(a, common, sum_m_);
    add_reach(b, common, sum_m_);
    for (const std::size_t body : {a, b}) {
      if (!robot_->known().bodies[body].is_asked) continue;
      auto row = known_reach_m_.row(static_cast<Eigen::Index>(body));
      row = row.cwiseMax(sum_m_.transpose());
    }
  }
}

void DistanceRows::add_reach(std::size_t body, std::size_t common, Eigen::VectorXd& sum_m) const {
  const std::vector<ChainJoint>& chain = chains_[body];
  for (std::size_t k = 0; k + common < chain.size(); ++k) {
    const Joint& joint = robot_->model().links[chain[k].link].joint;
    if (!joint.position_index) continue;
    sum_m[static_cast<Eigen::Index>(*joint.position_index)] +=
        std::abs(joint.multiplier) * chain[k].reach_m;
  }
}

std::size_t DistanceRows::common_joints(std::size_t body, std::size_t other) const {
  const std::vector<ChainJoint>&a = chains_[body], &b = chains_[other];
  std::size_t common = 0;
  while (common < std::min(a.size(), b.size()) &&
         a[a.size() - 1 - common].link == b[b.size() - 1 - common].link) {
    ++common;
  }
  return common;
}

}  // namespace berth
