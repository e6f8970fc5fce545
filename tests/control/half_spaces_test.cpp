// Drawn problems, degenerate ones among them, against all corners, edges and faces one by one in up
// to three dimensions, and against the conditions of Karush, Kuhn and Tucker, or Farkas, in all.
// BERTH_CONTROL_TWIN=full in the environment makes it 10^6.
#include "berth/control/half_spaces.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "sim/random.hpp"
#include "tests/control/cases.hpp"
#include "tests/support/allocation_count.hpp"

namespace berth {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Problem {
  MatrixXd normals;
  VectorXd bounds;
  VectorXd wanted;

  double least_slack(const VectorXd& x) const {
    return bounds.size() > 0 ? (normals * x - bounds).minCoeff()
                             : std::numeric_limits<double>::infinity();
  }
};

VectorXd draw_vector(sim::Random& random, Index size) {
  VectorXd v(size);
  for (double& number : v) number = random.gaussian();
  return v;
}

/// Rows that all hold at a drawn point, many of them just so; among them copies, longer ones, rows
/// that are nearly another one, and opposite ones. `broken` of them are then moved beyond the
/// point.
Problem draw_problem(sim::Random& random, Index unknowns, Index rows, double broken) {
  Problem out{MatrixXd(rows, unknowns), VectorXd(rows), 2 * draw_vector(random, unknowns)};
  const VectorXd inside = draw_vector(random, unknowns);
  for (Index i = 0; i < rows; ++i) {
    const int kind = i > 0 ? random.whole(0, 9) : 9;
    const Index other = random.whole(0, static_cast<int>(std::max<Index>(i, 1)) - 1);
    const VectorXd drawn = draw_vector(random, unknowns);
    VectorXd normal = drawn;
    if (kind < 4) normal = out.normals.row(other);
    if (kind == 1) normal *= std::pow(10, random(-2, 2));
    if (kind == 2) normal += std::pow(10, random(-5, -1)) * drawn;
    if (kind == 3) normal *= -1;
    if (kind == 4) normal.setZero();
    out.normals.row(i) = normal;
    const double slack = random.chance(0.4) ? 0 : std::pow(10, random(-3, 0.5));
    out.bounds[i] = normal.dot(inside) - slack * normal.norm();
    if (random.chance(broken)) out.bounds[i] += std::pow(10, random(-3, 0.5)) * normal.norm();
  }
  return out;
}

/// Takes each set of as many rows as there are unknowns, or fewer, for those that hold the point.
class AllCorners {
 public:
  AllCorners(const Problem& problem, double outside) : problem_(problem), outside_(outside) {}

  /// From the wanted point to the nearest that lies in all; infinite where none does.
  double least_distance() {
    try_rows({});
    for (Index a = 0; a < problem_.bounds.size(); ++a) {
      try_rows({a});
      for (Index b = 0; b < a && unknowns() > 1; ++b) {
        try_rows({a, b});
        for (Index c = 0; c < b && unknowns() > 2; ++c) try_rows({a, b, c});
      }
    }
    return least_;
  }

 private:
  Index unknowns() const { return problem_.wanted.size(); }

  void try_rows(const std::vector<Index>& rows) {
    const MatrixXd n = problem_.normals(rows, Eigen::all);
    const VectorXd off = problem_.bounds(rows) - n * problem_.wanted;
    const VectorXd x = problem_.wanted + VectorXd(n.completeOrthogonalDecomposition().solve(off));
    const VectorXd slack = problem_.normals * x - problem_.bounds;
    const VectorXd lengths = problem_.normals.rowwise().norm();
    if ((slack.array() < -outside_ * (lengths.array() + 1e-12)).any()) return;
    least_ = std::min(least_, (x - problem_.wanted).norm());
  }

  const Problem& problem_;
  /// How far a point may lie outside of a row.
  double outside_;
  double least_ = std::numeric_limits<double>::infinity();
};

bool solve(const Problem& problem, HalfSpaces& spaces) {
  spaces.clear();
  for (Index i = 0; i < problem.bounds.size(); ++i) {
    spaces.add(problem.normals.row(i).transpose(), problem.bounds[i]);
  }
  return spaces.project(problem.wanted);
}

/// Whether the answer proves itself.
void expect_proof(const Problem& problem, const HalfSpaces& spaces, bool is_found) {
  const VectorXd weights = spaces.weights();
  const VectorXd lengths = problem.normals.rowwise().norm();
  const VectorXd pull = problem.normals.transpose() * weights;
  EXPECT_TRUE((weights.array() >= 0).all());
  const double scale = 1 + weights.dot(lengths);
  if (!is_found) {
    EXPECT_LT(pull.norm(), 1e-8 * scale);
    EXPECT_GT(weights.dot(problem.bounds) - pull.dot(spaces.point()), 0);
    return;
  }
  const VectorXd slack = problem.normals * spaces.point() - problem.bounds;
  EXPECT_TRUE((slack.array() >= -1e-8 * (lengths.array() + 1e-12)).all());
  EXPECT_LT((problem.wanted + pull - spaces.point()).norm(), 1e-7 * scale);
  EXPECT_LT((weights.array() * slack.array()).abs().maxCoeff(), 1e-7 * scale);
}

TEST(HalfSpaces, FindsTheNearestOfAllCornersInThreeDimensions) {
  sim::Random random(1);
  int found = 0, none = 0;
  for (int k = 0; k < cases(500'000) && !HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const Index unknowns = random.whole(1, 3);
    const Problem problem =
        draw_problem(random, unknowns, random.whole(1, 7), random.chance(0.5) ? 0.2 : 0);
    HalfSpaces spaces(unknowns, problem.bounds.size());
    const bool is_found = solve(problem, spaces);
    expect_proof(problem, spaces, is_found);
    // Between rows that are nearly parallel a point is far from one that lies outside by little.
    const double least = AllCorners(problem, 1e-8).least_distance();
    const double most = AllCorners(problem, 1e-12).least_distance();
    if (is_found) {
      const double distance = (spaces.point() - problem.wanted).norm();
      EXPECT_GE(distance, least - 1e-6 * (1 + least));
      EXPECT_LE(distance, most + 1e-6 * (1 + most));
    } else {
      EXPECT_TRUE(std::isinf(most));
    }
    ++(is_found ? found : none);
  }
  EXPECT_GT(found, cases(500'000) / 4);
  EXPECT_GT(none, cases(500'000) / 20);
}

TEST(HalfSpaces, ProvesItsAnswersInTwentyDimensions) {
  sim::Random random(2);
  int found = 0, none = 0;
  for (int k = 0; k < cases(500'000) && !HasFailure(); ++k) {
    SCOPED_TRACE(k);
    const Index unknowns = random.whole(1, 20);
    // Few are as large as a filter's largest.
    const Index rows = random.chance(0.1) ? random.whole(1, 200) : random.whole(1, 40);
    const Problem problem = draw_problem(random, unknowns, rows, random.chance(0.5) ? 0.05 : 0);
    HalfSpaces spaces(unknowns, rows);
    const bool is_found = solve(problem, spaces);
    expect_proof(problem, spaces, is_found);
    ++(is_found ? found : none);
  }
  EXPECT_GT(found, cases(500'000) / 4);
  EXPECT_GT(none, cases(500'000) / 20);
}

TEST(HalfSpaces, WhatIsWantedStaysWhereItIsAllowed) {
  HalfSpaces spaces(2, 4);
  EXPECT_TRUE(spaces.project(Eigen::Vector2d(3, 4)));
  EXPECT_EQ(spaces.point(), Eigen::Vector2d(3, 4));
  spaces.add(Eigen::Vector2d(1, 0), 1);
  EXPECT_TRUE(spaces.project(Eigen::Vector2d(3, 4)));
  EXPECT_EQ(spaces.point(), Eigen::Vector2d(3, 4));
  EXPECT_EQ(spaces.weights()[0], 0);
}

TEST(HalfSpaces, AllocatesNothing) {
  sim::Random random(3);
  const Problem problem = draw_problem(random, 14, 100, 0);
  HalfSpaces spaces(14, 100);
  EXPECT_TRUE(solve(problem, spaces));
  const VectorXd normal = problem.normals.row(0).transpose();
  const std::size_t before = allocation_count();
  spaces.clear();
  spaces.add(normal, problem.bounds[0]);
  EXPECT_TRUE(spaces.project(problem.wanted));
  EXPECT_EQ(allocation_count(), before);
}

}  // namespace
}  // namespace berth
