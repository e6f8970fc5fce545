#include "berth/separation/braking_path.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

bool is_path(std::span<const JointState> path, std::size_t joints) {
  double last_s = -1;
  for (const JointState& state : path) {
    if (!(state.stamp_s > last_s) || state.position.size() != joints) return false;
    if (!std::ranges::all_of(state.position, [](double q) { return std::isfinite(q); })) {
      return false;
    }
    last_s = state.stamp_s;
  }
  return !path.empty() && path.front().stamp_s == 0;
}

/// Whether the robot stands where the path ends.
bool ends_at_rest(std::span<const JointState> path) {
  return path.size() >= 2 && path.back().position == path[path.size() - 2].position;
}

Pose joint_step(const Joint& joint, double step) {
  Pose X = Pose::Identity();
  if (joint.type == JointType::prismatic) {
    X.translation() = step * joint.axis_J;
  } else {
    X.linear() = Eigen::AngleAxisd(step, joint.axis_J).toRotationMatrix();
  }
  return X;
}

}  // namespace

BrakingPath::BrakingPath(std::shared_ptr<const Robot> robot, const std::vector<HullPoints>& hulls)
    : robot_(std::move(robot)), hulls_(hulls) {
  const RobotModel& model = robot_->model();
  for (std::size_t i = 0; i < hulls_.size(); ++i) {
    Chain& chain = chains_.emplace_back();
    for (const Eigen::Vector3f& p : hulls_[i].points_L_m) {
      chain.radius_m = std::max<double>(chain.radius_m, p.norm() + hulls_[i].slack_m);
    }
    chain.joints = joint_chain(model, model.evaluated_links[i]);
  }
  steps_.resize(kNodes * model.joints.size());
  corners_.resize(kPieces * model.joints.size());
  slides_.resize(model.joints.size());
  poses_.resize(kNodes);
  for (RobotPose& pose : poses_) pose.X_BL.resize(model.links.size());
  way_m_.resize(kNodes);
  most_way_m_.resize(kNodes);
  bend_m_.resize(hulls_.size() * kPieces);
}

const Pose& BrakingPath::X_BL(std::size_t i, int node) const {
  return poses_[static_cast<std::size_t>(node)].X_BL[robot_->model().evaluated_links[i]];
}

double BrakingPath::turned(int node, const Joint& joint) const {
  if (!joint.position_index) return 0;
  const std::size_t joints = robot_->model().joints.size();
  return joint.multiplier * steps_[static_cast<std::size_t>(node) * joints + *joint.position_index];
}

double BrakingPath::corner(int piece, const Joint& joint) const {
  if (!joint.position_index) return 0;
  const std::size_t joints = robot_->model().joints.size();
  return std::abs(joint.multiplier) *
         corners_[static_cast<std::size_t>(piece) * joints + *joint.position_index];
}

bool BrakingPath::lay(const RobotPose& now, const PlannedMotion& motion, double end_s) {
  piece_s_ = end_s / kPieces;
  if (!find_steps(motion)) return false;
  pose_nodes(now);
  find_slides();
  std::ranges::fill(way_m_, 0.0);
  std::ranges::fill(most_way_m_, 0.0);
  for (std::size_t i = 0; i < hulls_.size(); ++i) {
    if (!robot_->model().is_moved(robot_->model().evaluated_links[i])) continue;
    Chain& chain = chains_[i];
    find_reach(robot_->model(), now, chain.radius_m, slides_, chain.joints);
    // What is before a joint that slides moves with it (measure).
    for (std::size_t k = 1; k < chain.joints.size(); ++k) {
      double& reach_m = chain.joints[k].reach_m;
      reach_m = std::max(reach_m, chain.joints[k - 1].reach_m);
    }
    measure(i);
  }
  for (std::size_t n = 1; n < way_m_.size(); ++n) {
    way_m_[n] += way_m_[n - 1];
    most_way_m_[n] += most_way_m_[n - 1];
  }
  return true;
}

bool BrakingPath::find_steps(const PlannedMotion& motion) {
  const std::size_t joints = robot_->model().joints.size();
  std::ranges::fill(corners_, 0.0);
  if (motion.path.empty()) {
    for (int n = 0; n < kNodes; ++n) {
      for (std::size_t j = 0; j < joints; ++j) {
        steps_[static_cast<std::size_t>(n) * joints + j] = time_s(n) * motion.velocity[j];
      }
    }
    return true;
  }
  if (!is_path(motion.path, joints)) return false;
  if (motion.path.back().stamp_s < time_s(kPieces) && !ends_at_rest(motion.path)) return false;
  find_path_steps(motion.path);
  find_corners(motion.path);
  return true;
}

void BrakingPath::find_path_steps(std::span<const JointState> path) {
  const std::size_t joints = robot_->model().joints.size();
  const std::vector<double>& first = path.front().position;
  std::size_t after = 1;
  for (int n = 0; n < kNodes; ++n) {
    while (after < path.size() && path[after].stamp_s <= time_s(n)) ++after;
    const JointState& a = path[after - 1];
    const JointState& b = path[std::min(after, path.size() - 1)];
    const double share =
        after < path.size() ? (time_s(n) - a.stamp_s) / (b.stamp_s - a.stamp_s) : 0;
    for (std::size_t j = 0; j < joints; ++j) {
      steps_[static_cast<std::size_t>(n) * joints + j] =
          a.position[j] + share * (b.position[j] - a.position[j]) - first[j];
    }
  }
}

void BrakingPath::find_corners(std::span<const JointState> path) {
  const std::size_t joints = robot_->model().joints.size();
  for (const JointState& state : path) {
    const double at = state.stamp_s / piece_s_;
    if (!(at < kPieces)) break;
    const auto piece = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(piece);
    for (std::size_t j = 0; j < joints; ++j) {
      const double a = steps_[piece * joints + j], b = steps_[(piece + 1) * joints + j];
      const double off = state.position[j] - path.front().position[j] - (a + share * (b - a));
      double& corner = corners_[piece * joints + j];
      corner = std::max(corner, std::abs(off));
    }
  }
}

void BrakingPath::pose_nodes(const RobotPose& now) {
  const RobotModel& model = robot_->model();
  poses_[0].X_BL = now.X_BL;
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    const Link& link = model.links[l];
    // As the link stands to its parent now, whatever the joint's position is.
    const Pose X_PL = link.parent ? now.X_BL[*link.parent].inverse() * now.X_BL[l] : now.X_BL[l];
    for (int n = 1; n < kNodes; ++n) {
      std::vector<Pose>& X_BL = poses_[static_cast<std::size_t>(n)].X_BL;
      const Pose X_BP = link.parent ? X_BL[*link.parent] : Pose::Identity();
      X_BL[l] = X_BP * X_PL;
      if (link.joint.position_index)
        X_BL[l] = X_BL[l] * joint_step(link.joint, turned(n, link.joint));
    }
  }
}

void BrakingPath::find_slides() {
  std::ranges::fill(slides_, 0.0);
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    double& most = slides_[i % slides_.size()];
    most = std::max(most, std::abs(steps_[i]));
  }
}

// While the joints go straight on, a point's velocity is the sum of q'_j u_j over its joints, and
// moving joint k turns no u_j by more than the reach of the joint that is nearer to the point. So
// its acceleration is no more than (sum of |q'_j|) (sum of |q'_k| reach_k), and a point strays from
// the chord by an eighth of that times the square of the time.
void BrakingPath::measure(std::size_t i) {
  const RobotModel& model = robot_->model();
  for (int p = 0; p < kPieces; ++p) {
    double turned_by = 0, reached_m = 0, corner_m = 0;
    for (const ChainJoint& at : chains_[i].joints) {
      const Joint& joint = model.links[at.link].joint;
      const double step = std::abs(turned(p + 1, joint) - turned(p, joint));
      turned_by += step;
      reached_m += step * at.reach_m;
      corner_m += corner(p, joint) * at.reach_m;
    }
    const double bend_m = turned_by * reached_m / 8 + corner_m;
    const double chord_m = moved_m(i, p, p + 1);
    const auto piece = static_cast<std::size_t>(p);
    bend_m_[i * kPieces + piece] = bend_m;
    way_m_[piece + 1] = std::max(way_m_[piece + 1], chord_m);
    most_way_m_[piece + 1] = std::max(most_way_m_[piece + 1], chord_m + 4 * bend_m);
  }
}

double BrakingPath::fastest_m_s(int node) const {
  if (!(piece_s_ > 0)) return 0;
  double most_m = 0;
  for (int n = 1; n <= std::clamp(node, 1, kPieces); ++n) {
    most_m = std::max(most_m, most_way_m(n) - most_way_m(n - 1));
  }
  return most_m / piece_s_;
}

double BrakingPath::moved_m(std::size_t i, int from, int node) const {
  return greatest_displacement_m(hulls_[i], X_BL(i, from), X_BL(i, node));
}

}  // namespace berth
