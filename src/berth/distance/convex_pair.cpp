#include "berth/distance/convex_pair.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace berth::mesh {
namespace {

/// A corner of the difference of both bodies.
struct Corner {
  int a = 0;
  int b = 0;
  Eigen::Vector3d difference_m;
};

/// Up to four corners, and the weights of their point nearest to the origin.
struct Simplex {
  int count = 0;
  std::array<Corner, 4> corners;
  std::array<double, 4> weights{};
  Eigen::Vector3d nearest_m;
};

/// The weights of the point nearest to the origin on the plane through the corners in `subset`;
/// false where that point is outside of them, or they lie on less than such a plane.
bool nearest_of_subset(const Simplex& simplex, int subset, Simplex& out) {
  out.count = 0;
  for (int i = 0; i < simplex.count; ++i) {
    if (subset >> i & 1) out.corners[out.count++] = simplex.corners[i];
  }
  const Eigen::Vector3d first_m = out.corners[0].difference_m;
  const int edges = out.count - 1;
  out.weights[0] = 1;
  out.nearest_m = first_m;
  if (edges == 0) return true;
  Eigen::Matrix<double, 3, 3> edge_m = Eigen::Matrix3d::Zero();
  for (int i = 0; i < edges; ++i) edge_m.col(i) = out.corners[i + 1].difference_m - first_m;
  Eigen::Matrix3d gram = edge_m.transpose() * edge_m;
  for (int i = edges; i < 3; ++i) gram(i, i) = gram(0, 0);
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(gram);
  const Eigen::Vector3d pivots = ldlt.vectorD();
  if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff())) return false;
  const Eigen::Vector3d share = ldlt.solve(-edge_m.transpose() * first_m);
  for (int i = 0; i < edges; ++i) {
    if (share[i] < 0) return false;
    out.weights[i + 1] = share[i];
    out.weights[0] -= share[i];
    out.nearest_m += share[i] * edge_m.col(i);
  }
  // Where four corners enclose the origin their nearest point is the origin; flat ones do not.
  if (edges == 3 && !(out.nearest_m.norm() < 1e-9 * edge_m.norm())) return false;
  return out.weights[0] >= 0;
}

void shrink_to_nearest(Simplex& simplex) {
  Simplex best;
  best.nearest_m.setConstant(HUGE_VAL);
  Simplex candidate;
  for (int subset = 1; subset < 1 << simplex.count; ++subset) {
    if (nearest_of_subset(simplex, subset, candidate) &&
        candidate.nearest_m.squaredNorm() < best.nearest_m.squaredNorm()) {
      best = candidate;
    }
  }
  simplex = best;
}

Corner support(std::span<const Eigen::Vector3d> a_m, std::span<const Eigen::Vector3d> b_m,
               const Eigen::Vector3d& towards) {
  Corner corner;
  for (int i = 1; i < static_cast<int>(a_m.size()); ++i) {
    if (towards.dot(a_m[i]) < towards.dot(a_m[corner.a])) corner.a = i;
  }
  for (int i = 1; i < static_cast<int>(b_m.size()); ++i) {
    if (towards.dot(b_m[i]) > towards.dot(b_m[corner.b])) corner.b = i;
  }
  corner.difference_m = a_m[corner.a] - b_m[corner.b];
  return corner;
}

}  // namespace

ConvexPair closest_points(std::span<const Eigen::Vector3d> a_m,
                          std::span<const Eigen::Vector3d> b_m) {
  constexpr int kMostSteps = 50;
  constexpr double kContact_m = 1e-10;
  Simplex simplex;
  simplex.count = 1;
  simplex.corners[0] = {0, 0, a_m[0] - b_m[0]};
  shrink_to_nearest(simplex);
  for (int step = 0; step < kMostSteps; ++step) {
    const double squared_m2 = simplex.nearest_m.squaredNorm();
    if (simplex.count == 4 || squared_m2 < kContact_m * kContact_m) break;
    const Corner corner = support(a_m, b_m, simplex.nearest_m);
    if (squared_m2 - simplex.nearest_m.dot(corner.difference_m) <= 1e-12 * squared_m2) break;
    simplex.corners[simplex.count++] = corner;
    shrink_to_nearest(simplex);
    if (simplex.nearest_m.squaredNorm() >= squared_m2) break;
  }
  ConvexPair pair;
  pair.a_m.setZero();
  pair.b_m.setZero();
  for (int i = 0; i < simplex.count; ++i) {
    pair.a_m += simplex.weights[i] * a_m[simplex.corners[i].a];
    pair.b_m += simplex.weights[i] * b_m[simplex.corners[i].b];
  }
  pair.distance_m = (pair.a_m - pair.b_m).norm();
  if (simplex.count == 4 || pair.distance_m < kContact_m) {
    pair.b_m = pair.a_m;
    pair.distance_m = 0;
  }
  return pair;
}

}  // namespace berth::mesh
