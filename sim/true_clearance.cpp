#include "sim/true_clearance.hpp"

#include <algorithm>

#include "berth/distance/convex_pair.hpp"

namespace berth::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void place(const HullPoints& hull, const Pose& X_BM, std::vector<Eigen::Vector3d>& points_B_m) {
  points_B_m.clear();
  for (const Eigen::Vector3f& p : hull.points_L_m) points_B_m.push_back(X_BM * p.cast<double>());
}

}  // namespace

TrueClearance::Body TrueClearance::body_of(const TriangleMesh& mesh) {
  const Eigen::AlignedBox3f box = mesh.bounding_box_m();
  return {build_mesh_tree(mesh), hull_points(mesh, 0.004F), box.center().cast<double>(),
          box.diagonal().norm() / 2};
}

TrueClearance::TrueClearance(const RobotModel& model, const std::vector<TriangleMesh>& parts) {
  for (const std::size_t link : model.evaluated_links) {
    if (!model.is_moved(link)) continue;
    links_.push_back(link);
    link_bodies_.push_back(body_of(model.links[link].mesh_L));
  }
  for (const TriangleMesh& part : parts) parts_.push_back(body_of(part));
}

std::vector<TrueClearance::Candidate> TrueClearance::candidates(
    const RobotPose& pose, const std::vector<Pose>& X_BP) const {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Body& link = link_bodies_[i];
    const Eigen::Vector3d p_B = pose.X_BL[links_[i]] * link.centre_m;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const double between_m = (X_BP[k] * parts_[k].centre_m - p_B).norm();
      all.push_back({between_m - link.radius_m - parts_[k].radius_m, i, k});
    }
  }
  std::ranges::sort(all, {}, &Candidate::least_m);
  return all;
}

double TrueClearance::at(const RobotPose& pose, const std::vector<Pose>& X_BP) const {
  double nearest_m = kInfinity;
  for (const auto& [least_m, i, k] : candidates(pose, X_BP)) {
    if (least_m >= nearest_m || nearest_m <= 0) break;
    const SurfacePair pair = closest_points(link_bodies_[i].tree, pose.X_BL[links_[i]],
                                            parts_[k].tree, X_BP[k], nearest_m);
    nearest_m = std::min(nearest_m, pair.distance_m);
  }
  return nearest_m;
}

double TrueClearance::at_least(const RobotPose& pose, const std::vector<Pose>& X_BP) const {
  double nearest_m = kInfinity;
  std::vector<Eigen::Vector3d> link_m, part_m;
  for (const auto& [least_m, i, k] : candidates(pose, X_BP)) {
    if (least_m >= nearest_m) break;
    place(link_bodies_[i].hull, pose.X_BL[links_[i]], link_m);
    place(parts_[k].hull, X_BP[k], part_m);
    const double slack_m = link_bodies_[i].hull.slack_m + parts_[k].hull.slack_m;
    nearest_m = std::min(nearest_m, mesh::closest_points(link_m, part_m).distance_m - slack_m);
  }
  return nearest_m;
}

}  // namespace berth::sim
