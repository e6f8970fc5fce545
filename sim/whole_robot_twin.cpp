#include "sim/whole_robot_twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "sim/cube_content.hpp"

namespace berth::sim {
namespace {

/// What rounding may add to a distance.
constexpr double kRounding_m = 1e-6;

/// The root box of the search: everything within the range of the link.
CentredCube around(const TriangleMesh& mesh_L, const Pose& X_BL, double range_m) {
  Eigen::AlignedBox3d box;
  for (const auto& p : mesh_L.vertices_m) box.extend(X_BL * p.cast<double>());
  return {box.center(), box.sizes().maxCoeff() / 2 + range_m};
}

/// The nearest point of the mesh, in the frame B.
class LinkSurface {
 public:
  LinkSurface(const NearestOnMesh& mesh_L, const Pose& X_BL)
      : mesh_L_(mesh_L), X_BL_(X_BL), X_LB_(X_BL.inverse()) {}

  NearestPoint operator()(const Eigen::Vector3d& p_B, double less_than_m) const {
    NearestPoint nearest = mesh_L_(X_LB_ * p_B, less_than_m);
    nearest.point_m = X_BL_ * nearest.point_m;
    return nearest;
  }

 private:
  const NearestOnMesh& mesh_L_;
  const Pose X_BL_;
  const Pose X_LB_;
};

/// A cube that may hold what is wanted, and how near that can be.
struct Candidate {
  double lower_m;
  CentredCube cube;
  /// The nearest point of the mesh to its centre.
  Eigen::Vector3d robot_point_B;
  /// Its content is known to be all.
  bool is_full;

  bool operator<(const Candidate& other) const { return lower_m > other.lower_m; }
};

class Search {
 public:
  Search(const LinkSurface& surface, const PointSpace& space, Wanted wanted,
         const TwinSettings& settings)
      : surface_(surface), space_(space), content_(space), wanted_(wanted), settings_(settings) {}

  TwinInterval run(const CentredCube& root) {
    double least_given_up_m = settings_.range_m;
    double lower_m = settings_.range_m;
    add(root, 0, false);
    while (!queue_.empty()) {
      Candidate next = queue_.top();
      queue_.pop();
      if (next.lower_m >= std::min(settings_.range_m, found_.upper_m - settings_.gap_m) ||
          ++found_.cubes > settings_.most_cubes) {
        lower_m = std::min(lower_m, next.lower_m);
        break;
      }
      if (!next.is_full) {
        const Content content = content_(next.cube, wanted_);
        if (content == Content::none) continue;
        next.is_full = content == Content::all;
      }
      try_points(next);
      if (2 * next.cube.half_m <= settings_.least_edge_m) {
        least_given_up_m = std::min(least_given_up_m, next.lower_m);
      } else {
        split(next);
      }
    }
    found_.lower_m = std::min({lower_m, least_given_up_m, found_.upper_m});
    return found_;
  }

 private:
  void add(const CentredCube& cube, double at_least_m, bool is_full) {
    const double radius_m = std::numbers::sqrt3 * cube.half_m;
    const double most_m = std::min(settings_.range_m, found_.upper_m);
    const NearestPoint nearest = surface_(cube.centre_B, most_m + radius_m + kRounding_m);
    if (std::isinf(nearest.distance_m)) return;
    const double lower_m = std::max(at_least_m, nearest.distance_m - radius_m - kRounding_m);
    queue_.push({lower_m, cube, nearest.point_m, is_full});
  }

  void split(const Candidate& parent) {
    const double half_m = parent.cube.half_m / 2;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      add({parent.cube.centre_B + half_m * sign, half_m}, parent.lower_m, parent.is_full);
    }
  }

  /// The cube's point that is next to the robot, and its centre.
  void try_points(const Candidate& candidate) {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(candidate.cube.half_m);
    const Eigen::Vector3d near_B = candidate.robot_point_B.cwiseMin(candidate.cube.centre_B + half)
                                       .cwiseMax(candidate.cube.centre_B - half);
    try_point(near_B);
    try_point(candidate.cube.centre_B);
  }

  void try_point(const Eigen::Vector3d& p_B) {
    const NearestPoint nearest = surface_(p_B, std::min(settings_.range_m, found_.upper_m));
    if (std::isinf(nearest.distance_m)) return;
    if (!(wanted_ == Wanted::reading ? space_.is_reading(p_B) : space_.is_obstacle(p_B))) return;
    found_.upper_m = nearest.distance_m;
    found_.robot_point_B = nearest.point_m;
    found_.obstacle_point_B = p_B;
  }

  const LinkSurface& surface_;
  const PointSpace& space_;
  const CubeContent content_;
  const Wanted wanted_;
  const TwinSettings& settings_;
  std::priority_queue<Candidate> queue_;
  TwinInterval found_;
};

}  // namespace

TwinDistance twin_distance(const TriangleMesh& mesh_L, const Pose& X_BL, const PointSpace& space,
                           const TwinSettings& settings) {
  const NearestOnMesh nearest_L(mesh_L);
  const LinkSurface surface(nearest_L, X_BL);
  const CentredCube root = around(mesh_L, X_BL, settings.range_m);
  return {Search(surface, space, Wanted::obstacle, settings).run(root),
          Search(surface, space, Wanted::reading, settings).run(root)};
}

std::vector<TwinDistance> twin_distances(const RobotModel& model, const RobotPose& pose,
                                         const PointSpace& space, const TwinSettings& settings) {
  std::vector<TwinDistance> distances;
  for (const std::size_t i : model.evaluated_links) {
    distances.push_back(twin_distance(model.links[i].mesh_L, pose.X_BL[i], space, settings));
  }
  return distances;
}

}  // namespace berth::sim
