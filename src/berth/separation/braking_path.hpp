// Inside separation/ only: where the robot may be from a request until it stands.
#pragma once

#include <memory>
#include <vector>

#include "berth/pipeline/robot.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/separation/link_speed.hpp"
#include "berth/separation/planned_motion.hpp"

namespace berth {

/// The robot's way as poses one after another, and how far its links move between them at most: so
/// what is known of some poses holds for all that lie between.
class BrakingPath {
 public:
  static constexpr int kPieces = 24;
  static constexpr int kNodes = kPieces + 1;

  /// hulls[i] is of the link with the id i + 1.
  BrakingPath(std::shared_ptr<const Robot> robot, const std::vector<HullPoints>& hulls);

  /// Lays the poses side by side, from `now` to where the robot is after end_s at full speed.
  /// Returns whether the motion gives its way so far.
  bool lay(const RobotPose& now, const PlannedMotion& motion, double end_s);

  /// When the robot is there at full speed.
  double time_s(int node) const { return node * piece_s_; }
  /// The pose of the link with the id i + 1.
  const Pose& X_BL(std::size_t i, int node) const;
  /// The way of the robot's fastest points so far is at least, and at most, so long.
  double way_m(int node) const { return way_m_[static_cast<std::size_t>(node)]; }
  double most_way_m(int node) const { return most_way_m_[static_cast<std::size_t>(node)]; }
  /// No point of the robot is faster on its way up to there, at full speed.
  double fastest_m_s(int node) const;
  /// No point of the link is farther from where it was at the other node.
  double moved_m(std::size_t i, int from, int node) const;
  /// And none between two nodes that follow each other, from the straight line between both.
  double bend_m(std::size_t i, int piece) const {
    return bend_m_[i * kPieces + static_cast<std::size_t>(piece)];
  }

 private:
  struct Chain {
    double radius_m = 0;
    /// From the link itself to the root.
    std::vector<ChainJoint> joints;
  };

  bool find_steps(const PlannedMotion& motion);
  void find_path_steps(std::span<const JointState> path);
  /// How far the states inside of a piece lie from the straight line.
  void find_corners(std::span<const JointState> path);
  void pose_nodes(const RobotPose& now);
  void find_slides();
  void measure(std::size_t i);
  /// Of the model's joint of this link, from the first node to this one; rad or m.
  double turned(int node, const Joint& joint) const;
  double corner(int piece, const Joint& joint) const;

  std::shared_ptr<const Robot> robot_;
  const std::vector<HullPoints>& hulls_;
  /// chains_[i] is of the link with the id i + 1.
  std::vector<Chain> chains_;
  double piece_s_ = 0;
  /// By node and joint: from the first node; by piece and joint.
  std::vector<double> steps_;
  std::vector<double> corners_;
  /// By joint: how far it goes from the first node at most.
  std::vector<double> slides_;
  std::vector<RobotPose> poses_;
  std::vector<double> way_m_;
  std::vector<double> most_way_m_;
  std::vector<double> bend_m_;
};

}  // namespace berth
