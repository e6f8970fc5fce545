// Inside distance/ only: how near two links are, from request to request.
#pragma once

#include <optional>
#include <vector>

#include "berth/distance/known_model.hpp"
#include "berth/distance/link_search.hpp"
#include "berth/distance/settings.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth::mesh {

/// Starts with both whole links, and an empty front. X_BL of the search is the pose of its link in
/// the frame of the other one.
void start_link_pair(const LinkPatches& other, LinkSearch& search);

/// Goes on with the front of the request before: what may be near enough by now is searched for. Of
/// two leaves it is seen first whether the plane that was found between them still is.
void take_link_pair_below(const LinkPatches& other, LinkSearch& search);

/// Searches on among the triangles of `other`. Ends when the search is done, or after about `steps`
/// patches. `best_pixel` is the place of the other link's triangle.
void search_link_pair(const LinkPatches& other, int steps, LinkSearch& search);

/// By how much a plane keeps all of two links apart, with the link at X_FL in the frame of `other`:
/// across the way from the best pair's point of the other one to that of the link. Below 0 where it
/// does not.
float apart_at_pair_m(const LinkPatches& other, const Pose& X_FL, const LinkSearch& search);

/// The closest points of the best pair's triangles. There is one.
ConvexPair best_pair_of(const LinkPatches& other, const LinkSearch& search);

/// What is known of two bodies since they were looked at.
class BodyPair {
 public:
  BodyPair();

  /// Nothing is known.
  void forget();

  /// Takes along what was found, without a search: points move with their bodies. The bound falls
  /// by how far the one has moved against the other since, or is that of a plane between both
  /// across the way from point to point, which is as good as the distance while they are convex
  /// there. Returns whether that says enough: nothing is nearer than `needed_m`, or the distance is
  /// known to `tolerance_m`.
  bool follow(const KnownBody& link, const KnownBody& other, const RobotPose& pose, float needed_m,
              float tolerance_m);

  /// Looks how near `link` is to `other`, up to request.range_m, where nothing is nearer than
  /// `known_bound_m`. Goes on from the call before, which was about the same bodies.
  void find(const KnownBody& link, const KnownBody& other, const RobotPose& pose,
            const MeshRequest& request, float known_bound_m);

  /// Infinite where there is no pair within the range; 0 where they are inside one another.
  float distance_m() const { return distance_m_; }
  float lower_bound_m() const { return lower_bound_m_; }
  /// The points of a pair in the frame B that `pose` is of; both the same where they are inside
  /// one another.
  const Eigen::Vector3d& link_point_B_m() const { return link_point_B_m_; }
  const Eigen::Vector3d& other_point_B_m() const { return other_point_B_m_; }

 private:
  void search_on(const LinkPatches& other);
  void tell(const KnownBody& other, const Pose& X_BF);

  LinkSearch search_;
  bool has_begun_ = false;
  /// One has a whole part within the other, at this point of the other one's frame.
  std::optional<Eigen::Vector3d> inside_F_m_;
  /// The surfaces are so far apart that this cannot have changed until one moved by more.
  float room_m_ = 0;
  /// Nothing was nearer than this with the link at this pose in the other one's frame, and is now.
  float known_bound_m_ = 0;
  Pose known_X_FL_ = Pose::Identity();
  float lower_bound_m_ = 0;
  float distance_m_ = 0;
  Eigen::Vector3d link_point_B_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d other_point_B_m_ = Eigen::Vector3d::Zero();
};

/// Whether two bodies touch, in many poses of the same two.
class TouchSearch {
 public:
  /// Whether they are nearer than 0.1 mm or inside one another.
  bool is_touching(const KnownBody& link, const KnownBody& other, const RobotPose& pose);

 private:
  LinkSearch search_;
  /// Leaves that touched: some of them do so again.
  std::vector<Item> places_;
};

}  // namespace berth::mesh
