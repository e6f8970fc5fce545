#pragma once

#include <vector>

#include "berth/robot/kinematics.hpp"
#include "berth/separation/link_speed.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::sim {

/// How near arm and person truly are.
class TrueClearance {
 public:
  /// Of the links that a joint moves.
  TrueClearance(const RobotModel& model, const std::vector<TriangleMesh>& parts);

  /// Mesh to mesh, by FCL; 0 where they meet. Takes milliseconds.
  double at(const RobotPose& pose, const std::vector<Pose>& X_BP) const;
  /// They are not nearer than this: convex hull to convex hull. Negative where the hulls meet, or
  /// nearly. Takes a tenth of a millisecond.
  double at_least(const RobotPose& pose, const std::vector<Pose>& X_BP) const;

 private:
  struct Body {
    MeshTree tree;
    HullPoints hull;
    /// Around the mesh, in its own frame.
    Eigen::Vector3d centre_m;
    double radius_m;
  };
  /// A link and a part, and how near the balls around them are.
  struct Candidate {
    double least_m;
    std::size_t link;
    std::size_t part;
  };
  static Body body_of(const TriangleMesh& mesh);
  std::vector<Candidate> candidates(const RobotPose& pose, const std::vector<Pose>& X_BP) const;

  std::vector<std::size_t> links_;
  std::vector<Body> link_bodies_;
  std::vector<Body> parts_;
};

}  // namespace berth::sim
