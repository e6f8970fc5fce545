// How far an answer is from brute force's (Hirt 3.2, figure 3.9).
#pragma once

#include "thesis/link_distance.hpp"

namespace berth::lab {

/// Values, by what is left of them.
struct Spread {
  int count = 0;
  double sum = 0;
  double sum_of_squares = 0;
  double greatest = 0;

  void add(double value);
  double mean() const { return sum / count; }
  /// Of the values themselves, not of a population that they were drawn from.
  double deviation() const;
};

struct LinkErrors {
  /// Links with a true distance within the range.
  int links_in_range = 0;
  /// Those of them for which the answer has none.
  int links_missed = 0;
  /// Over the links that have both: the difference of the distances; how far the robot points lie
  /// apart; how far the obstacle points do.
  Spread distance_mm;
  Spread robot_point_mm;
  Spread obstacle_point_mm;
};

/// `truth` may have been asked for with a greater range than range_m, `answer` was with range_m.
/// The links of both are the same ones.
LinkErrors errors_of(const LinkDistances& truth, const LinkDistances& answer, double range_m);

}  // namespace berth::lab
