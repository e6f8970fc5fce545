// The obstacle pixels around a robot pixel in the order of a search pattern (Hirt 3.1.2).
#pragma once

#include <algorithm>

#include "berth/types/image.hpp"
#include "thesis/surveillance_settings.hpp"

namespace berth {

/// Every x-th column and y-th row, counted from the robot pixel's: at least 1.
struct PixelStep {
  int x = 1;
  int y = 1;
};

/// The pixels (u + i du, v + i dv) for 0 <= i < count, along a row or a column.
struct PixelRun {
  int u;
  int v;
  int du;
  int dv;
  int count;
};

/// Every step-th coordinate in [begin, end), counted from the origin.
struct Stride {
  int first;
  int count;
};

inline Stride stride_within(int origin, int step, int begin, int end) {
  const int ahead = (origin - begin) % step;
  const int first = begin + (ahead < 0 ? ahead + step : ahead);
  return {first, first < end ? (end - 1 - first) / step + 1 : 0};
}

/// The run in row v, of the columns in [u_begin, u_end).
inline PixelRun row_run(Pixel robot, PixelStep step, int v, int u_begin, int u_end) {
  const Stride columns = stride_within(robot.u, step.x, u_begin, u_end);
  return {columns.first, v, step.x, 0, columns.count};
}

/// The run in column u, of the rows in [v_begin, v_end).
inline PixelRun column_run(Pixel robot, PixelStep step, int u, int v_begin, int v_end) {
  const Stride rows = stride_within(robot.v, step.y, v_begin, v_end);
  return {u, rows.first, 0, step.y, rows.count};
}

template <class Visit>
void visit_row_major(Pixel robot, PixelStep step, const PixelRect& rect, Visit visit) {
  const auto row_from = [&](int v) { return stride_within(robot.v, step.y, v, rect.v_end).first; };
  for (int v = row_from(rect.v_begin); v < rect.v_end;
       v = row_from(std::max(v + 1, rect.v_begin))) {
    visit(row_run(robot, step, v, rect.u_begin, rect.u_end));
  }
}

template <class Visit>
void visit_oscillating(Pixel robot, PixelStep step, const PixelRect& rect, Visit visit) {
  const auto visit_row = [&](int v) {
    if (v < rect.v_begin || v >= rect.v_end) return;
    visit(row_run(robot, step, v, rect.u_begin, rect.u_end));
  };
  visit_row(robot.v);
  for (int d = step.y; robot.v + d < rect.v_end || robot.v - d >= rect.v_begin; d += step.y) {
    visit_row(robot.v + d);
    visit_row(robot.v - d);
  }
}

/// The ring's rows have its corners.
template <class Visit>
void visit_ring(Pixel robot, PixelStep step, int du, int dv, const PixelRect& rect, Visit visit) {
  const auto visit_row = [&](int v) {
    if (v < rect.v_begin || v >= rect.v_end) return;
    visit(row_run(robot, step, v, std::max(robot.u - du, rect.u_begin),
                  std::min(robot.u + du + 1, rect.u_end)));
  };
  const auto visit_column = [&](int u) {
    if (u < rect.u_begin || u >= rect.u_end) return;
    visit(column_run(robot, step, u, std::max(robot.v - dv + 1, rect.v_begin),
                     std::min(robot.v + dv, rect.v_end)));
  };
  visit_row(robot.v - dv);
  visit_column(robot.u + du);
  visit_row(robot.v + dv);
  visit_column(robot.u - du);
}

template <class Visit>
void visit_spiral(Pixel robot, PixelStep step, const PixelRect& rect, Visit visit) {
  visit(row_run(robot, step, robot.v, robot.u, robot.u + 1));
  const auto reaches_in = [&](int du, int dv) {
    return robot.u - du >= rect.u_begin || robot.u + du < rect.u_end ||
           robot.v - dv >= rect.v_begin || robot.v + dv < rect.v_end;
  };
  int dv = step.y;
  for (int du = step.x; reaches_in(du, dv); du += step.x, dv += step.y) {
    visit_ring(robot, step, du, dv, rect, visit);
  }
}

/// Calls visit(PixelRun) for every step-th pixel of `rect`, each pixel once. `rect` holds the robot
/// pixel and may shrink meanwhile: what has fallen out of it is not visited any more. A run may be
/// empty.
template <class Visit>
void visit_runs(SearchPattern pattern, Pixel robot, PixelStep step, const PixelRect& rect,
                Visit visit) {
  switch (pattern) {
    case SearchPattern::row_major:
      visit_row_major(robot, step, rect, visit);
      break;
    case SearchPattern::oscillating:
      visit_oscillating(robot, step, rect, visit);
      break;
    case SearchPattern::spiral:
      visit_spiral(robot, step, rect, visit);
      break;
  }
}

}  // namespace berth
