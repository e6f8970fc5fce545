// Somebody who does at the arm what a person did before the cameras of a motion capture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "sim/bvh.hpp"

namespace berth::sim {

/// The joints of the two hands, at the wrists: those whose names end with "hand". Throws
/// std::runtime_error with file, what is there and what was expected where there are not two.
std::vector<std::size_t> hand_joints(const Bvh& motion);
/// Where a hand's middle is in its joint's frame: on from the forearm.
Eigen::Vector3d hand_middle_m(const Bvh& motion, std::size_t hand_joint);

/// Who, what and where depends on `motions` and `seed` alone: one of the motions, lengths by a
/// factor of 0.9 to 1.1, and three seconds of it, or to and fro until they are over. The hands'
/// mean place is drawn 0.6 to 1.1 m from the base's axis, at the border of the arm's work (0.67 m),
/// on any side that no camera of his height stands on; then the person is moved outwards until
/// nothing of him is in or below the table. He comes from 2 m farther away, as he stands when he
/// begins, and goes away as he stands at the end.
class MeasuredPerson {
 public:
  /// `motions` is not empty, and outlives it. Throws as hand_joints().
  MeasuredPerson(std::span<const Bvh> motions, std::uint32_t seed);

  /// Capsules along the bones, head and hands; each is fixed to a joint.
  const std::vector<TriangleMesh>& meshes() const { return meshes_; }
  /// X_BM of each mesh. Before 0 and after duration_s() he walks on, 1.0 to 1.6 m/s.
  std::vector<Pose> pose_at(double time_s) const;
  double duration_s() const;
  double speed_m_s() const { return speed_m_s_; }

 private:
  void make_body();
  void place(double direction_rad, double range_m, double turn_rad);
  /// X_BM while he works, so long after he began.
  std::vector<Pose> working(double time_s) const;
  double walk_s() const;

  const Bvh* motion_;
  double factor_;
  /// Within the motion.
  double first_s_;
  double speed_m_s_;
  std::vector<TriangleMesh> meshes_;
  /// joints_[i] carries meshes_[i].
  std::vector<std::size_t> joints_;
  Pose X_BW_ = Pose::Identity();
  Eigen::Vector3d outwards_;
};

}  // namespace berth::sim
