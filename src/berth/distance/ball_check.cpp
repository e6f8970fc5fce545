#include "berth/distance/ball_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/distance/ball_check.cpp"
#include "hwy/foreach_target.h"

#include "berth/vector/lanes-inl.hpp"
#include "hwy/contrib/math/math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace berth::mesh {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Balls come by eight: no more lanes than that.
using Tag = hn::CappedTag<float, 8>;
using IntTag = hn::RebindToSigned<Tag>;
using Floats = hn::Vec<Tag>;
using Ints = hn::Vec<IntTag>;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(Tag()));
constexpr unsigned kAllLanes = (1u << kWidth) - 1;

HWY_INLINE Floats all(float x) { return hn::Set(Tag(), x); }
HWY_INLINE Ints all(int x) { return hn::Set(IntTag(), x); }
HWY_INLINE unsigned bits(hn::Mask<Tag> mask) {
  return static_cast<unsigned>(berth::HWY_NAMESPACE::bits_of(Tag(), mask));
}

/// Where the frames stand in eight configurations: R by rows, then t.
struct EightPoses {
  alignas(32) float m[12][8];
};
struct EightNumbers {
  alignas(32) float of[8];
};

/// The same of one configuration, for eight balls.
struct LinkPlace {
  Floats m[12];
};
HWY_INLINE LinkPlace place_of(const EightPoses& poses, int lane) {
  LinkPlace out;
  for (int k = 0; k < 12; ++k) out.m[k] = all(poses.m[k][lane]);
  return out;
}

struct Places {
  Floats x, y, z;
};
HWY_INLINE Places moved(const LinkPlace& X, const EightBalls& balls, int i) {
  const Tag d;
  const Floats x = hn::Load(d, &balls.x_m[i]), y = hn::Load(d, &balls.y_m[i]),
               z = hn::Load(d, &balls.z_m[i]);
  const auto row = [&](int k) HWY_ATTR {
    return hn::MulAdd(X.m[3 * k], x,
                      hn::MulAdd(X.m[3 * k + 1], y, hn::MulAdd(X.m[3 * k + 2], z, X.m[9 + k])));
  };
  return {row(0), row(1), row(2)};
}

/// Sets one part of the eight poses of a frame.
HWY_INLINE void place_frame(const BallFrame& frame, const EightPoses* before,
                            const EightNumbers& joint, int i, EightPoses& out) {
  const Tag d;
  const Floats q = hn::Load(d, &joint.of[i]);
  Floats turned[9], shift[3];
  const Floats cos = frame.is_slide ? all(0.0f) : hn::Cos(d, q);
  const Floats sin = frame.is_slide ? all(0.0f) : hn::Sin(d, q);
  for (int k = 0; k < 9; ++k) {
    const int row = k / 3, column = k % 3;
    turned[k] = hn::MulAdd(
        all(frame.of_cos(row, column)), cos,
        hn::MulAdd(all(frame.of_sin(row, column)), sin, all(frame.of_none(row, column))));
  }
  for (int k = 0; k < 3; ++k) shift[k] = hn::MulAdd(all(frame.slide[k]), q, all(frame.at_m[k]));
  if (!before) {
    for (int k = 0; k < 9; ++k) hn::Store(turned[k], d, &out.m[k][i]);
    for (int k = 0; k < 3; ++k) hn::Store(shift[k], d, &out.m[9 + k][i]);
    return;
  }
  const auto of = [&](int k) HWY_ATTR { return hn::Load(d, &before->m[k][i]); };
  for (int row = 0; row < 3; ++row) {
    const Floats a = of(3 * row), b = of(3 * row + 1), c = of(3 * row + 2);
    for (int column = 0; column < 3; ++column) {
      const Floats sum = hn::MulAdd(
          a, turned[column], hn::MulAdd(b, turned[3 + column], hn::Mul(c, turned[6 + column])));
      hn::Store(sum, d, &out.m[3 * row + column][i]);
    }
    const Floats at =
        hn::MulAdd(a, shift[0], hn::MulAdd(b, shift[1], hn::MulAdd(c, shift[2], of(9 + row))));
    hn::Store(at, d, &out.m[9 + row][i]);
  }
}

HWY_INLINE void place_frames(const BallRobot& robot, const std::vector<EightNumbers>& joints,
                             std::vector<EightPoses>& out) {
  for (std::size_t f = 0; f < robot.frames.size(); ++f) {
    const BallFrame& frame = robot.frames[f];
    const EightPoses* const before = frame.parent < 0 ? nullptr : &out[frame.parent];
    for (int i = 0; i < 8; i += kWidth) place_frame(frame, before, joints[f], i, out[f]);
  }
}

/// What the field says of some places: the square of the distance, in boxes, from below, and how
/// it grows from node to node.
struct FieldThere {
  Floats squared;
  Floats slope[3];
  /// Elsewhere the nearest place in the grid has it.
  hn::Mask<Tag> is_in;
};

HWY_INLINE FieldThere field_at(const ClearanceField::Grid& grid, const Places& p) {
  const Tag d;
  const IntTag ints;
  const Floats per_m = all(static_cast<float>(1 / ClearanceField::kCell_m));
  Floats cell[3], share[3];
  FieldThere out;
  out.is_in = hn::Eq(per_m, per_m);
  const Floats of_B[3] = {p.x, p.y, p.z};
  for (int k = 0; k < 3; ++k) {
    const Floats at = hn::Mul(hn::Sub(of_B[k], all(grid.low_B_m[k])), per_m);
    // The last node that has another one after it.
    const Floats last = all(static_cast<float>(grid.count[k] - 2));
    cell[k] = hn::Max(hn::Min(hn::Floor(at), last), all(0.0f));
    share[k] = hn::Sub(at, cell[k]);
    out.is_in =
        hn::And(out.is_in, hn::And(hn::Ge(share[k], all(0.0f)), hn::Le(share[k], all(1.0f))));
    share[k] = hn::Min(hn::Max(share[k], all(0.0f)), all(1.0f));
  }
  const int row = grid.count[0], layer = grid.count[0] * grid.count[1];
  const Ints first = hn::Add(hn::ConvertTo(ints, cell[0]),
                             hn::Add(hn::Mul(hn::ConvertTo(ints, cell[1]), all(row)),
                                     hn::Mul(hn::ConvertTo(ints, cell[2]), all(layer))));
  const auto* const pairs = reinterpret_cast<const std::int32_t*>(grid.squared);
  const auto between = [&](Floats a, Floats b, int k)
                           HWY_ATTR { return hn::MulAdd(share[k], hn::Sub(b, a), a); };
  // Two nodes beside one another in one number.
  Floats along_x[4], growth[4];
  for (int i = 0; i < 4; ++i) {
    const int further = (i & 1) * row + (i >> 1) * layer;
    const Ints both = hn::GatherOffset(ints, pairs, hn::ShiftLeft<1>(hn::Add(first, all(further))));
    const Floats a = hn::ConvertTo(d, hn::And(both, all(0xFFFF)));
    const Floats b = hn::ConvertTo(
        d,
        hn::BitCast(ints, hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<IntTag>(), both))));
    growth[i] = hn::Sub(b, a);
    along_x[i] = hn::MulAdd(share[0], growth[i], a);
  }
  const Floats below = between(along_x[0], along_x[1], 1),
               above = between(along_x[2], along_x[3], 1);
  out.slope[0] = between(between(growth[0], growth[1], 1), between(growth[2], growth[3], 1), 2);
  out.slope[1] = between(hn::Sub(along_x[1], along_x[0]), hn::Sub(along_x[3], along_x[2]), 2);
  out.slope[2] = hn::Sub(above, below);
  const auto sag = [&](int k) HWY_ATTR { return hn::Mul(share[k], hn::Sub(all(1.0f), share[k])); };
  constexpr float kBoxes = 16, kRounding = 5e-3f;
  out.squared = hn::Sub(hn::NegMulAdd(all(kBoxes), hn::Add(sag(0), hn::Add(sag(1), sag(2))),
                                      between(below, above, 2)),
                        all(kRounding));
  return out;
}

constexpr auto kPerBox_m = static_cast<float>(1 / ClearanceField::kBox_m);

/// The balls that are not certainly farther away than the margin.
HWY_INLINE unsigned not_free(const ClearanceField::Grid& grid, const Places& p, Floats radius,
                             Floats margin) {
  const FieldThere field = field_at(grid, p);
  const Floats need = hn::Mul(hn::Add(radius, margin), all(kPerBox_m));
  const auto is_free = hn::And(field.is_in, hn::Gt(field.squared, hn::Mul(need, need)));
  const auto is_none = hn::Lt(radius, all(0.0f));
  return kAllLanes & ~bits(hn::Or(is_free, is_none));
}

/// The points that are certainly no farther away than limit_m.
HWY_INLINE unsigned near_points(const ClearanceField::Grid& grid, const Places& p, float limit_m) {
  const Tag d;
  const IntTag ints;
  const FieldThere field = field_at(grid, p);
  const float limit = limit_m * kPerBox_m;
  const auto is_far = hn::And(field.is_in, hn::Gt(field.squared, all(limit * limit)));
  if (hn::AllTrue(d, is_far)) return 0;
  // Where the nearest box should be, and half a box farther.
  const Floats* const slope = field.slope;
  const Floats steep = hn::Sqrt(
      hn::MulAdd(slope[0], slope[0], hn::MulAdd(slope[1], slope[1], hn::Mul(slope[2], slope[2]))));
  const Floats way_m = hn::Mul(hn::Add(hn::Sqrt(hn::Max(field.squared, all(0.0f))), all(0.5f)),
                               all(static_cast<float>(ClearanceField::kBox_m)));
  const Floats per_slope = hn::Div(way_m, hn::Max(steep, all(1e-3f)));
  constexpr auto kEdge_m = static_cast<float>(ClearanceField::kCell_m);
  const Floats of_B[3] = {p.x, p.y, p.z};
  Floats cell[3];
  // The eight cells whose common corner is nearest to it.
  for (int k = 0; k < 3; ++k) {
    const Floats there = hn::NegMulAdd(slope[k], per_slope, of_B[k]);
    const Floats at =
        hn::MulAdd(hn::Sub(there, all(grid.low_B_m[k])), all(1 / kEdge_m), all(-0.5f));
    const Floats last = all(static_cast<float>(grid.count[k] - 2));
    cell[k] = hn::Max(hn::Min(hn::Floor(at), last), all(0.0f));
  }
  const int row = grid.count[0], layer = grid.count[0] * grid.count[1];
  const Ints first = hn::Add(hn::ConvertTo(ints, cell[0]),
                             hn::Add(hn::Mul(hn::ConvertTo(ints, cell[1]), all(row)),
                                     hn::Mul(hn::ConvertTo(ints, cell[2]), all(layer))));
  constexpr auto kStep_m = static_cast<float>(Cube::kLeastEdge_m);
  const auto* const points = reinterpret_cast<const std::int32_t*>(grid.point);
  Floats least = all(HUGE_VALF);
  for (int i = 0; i < 8; ++i) {
    const int odd[3] = {i & 1, i >> 1 & 1, i >> 2};
    const int further = odd[0] + row * odd[1] + layer * odd[2];
    const Ints point = hn::GatherIndex(ints, points, hn::Add(first, all(further)));
    Floats squared = all(0.0f);
    for (int k = 0; k < 3; ++k) {
      const Ints steps = hn::And(hn::ShiftRightSame(point, 10 * k), all(1023));
      const Floats in_cell = hn::MulAdd(hn::ConvertTo(d, steps), all(kStep_m), all(kStep_m / 2));
      const Floats low = hn::MulAdd(hn::Add(cell[k], all(static_cast<float>(odd[k]))), all(kEdge_m),
                                    all(grid.low_B_m[k]));
      const Floats apart = hn::Sub(of_B[k], hn::Add(low, in_cell));
      squared = hn::MulAdd(apart, apart, squared);
    }
    const auto is_none = hn::RebindMask(d, hn::Eq(point, all(-1)));
    least = hn::Min(least, hn::IfThenElse(is_none, all(HUGE_VALF), squared));
  }
  return bits(hn::Le(least, all(limit_m * limit_m)));
}

/// What pays for roundings: of a ball's centre, and of a point's.
constexpr float kFreeRounding_m = 2e-5f, kNearRounding_m = 4e-5f;
/// A point of a mesh stands by half of a step beside it in each direction.
constexpr float kMeshPoint_m = 1e-4f;

/// One configuration, held against one field.
struct Asked {
  const BallRequest& request;
  const ClearanceField::Grid& grid;
  /// Of each link; NaN: it is left out.
  std::span<const float> margins_m;
  float near_rounding_m;
  const std::vector<EightPoses>& poses;
  /// Of each frame.
  const std::vector<EightNumbers>& joints;
  int lane;
  /// How much farther than its margin each link has to be; null: no farther.
  const std::vector<EightNumbers>* moves_m;
  /// Whether the exact search may be asked for links that one joint moves.
  bool asks_first;

  float margin_m(std::size_t l) const { return margins_m[l]; }
  /// What has to be shown of it.
  float needed_m(std::size_t l) const {
    return margin_m(l) + (moves_m ? (*moves_m)[l].of[lane] : 0) + kFreeRounding_m;
  }
  LinkBounds first_link_bounds(std::size_t l) const {
    const std::size_t frame = request.robot.links[l].frame;
    return request.first_link_bounds(l, joints[frame].of[lane]);
  }
};

HWY_INLINE unsigned not_free(const Asked& asked, const LinkPlace& X, std::size_t l,
                             const EightBalls& balls) {
  const Floats margin = all(asked.needed_m(l));
  unsigned left = 0;
  for (int i = 0; i < 8; i += kWidth) {
    const Floats radius = hn::Load(Tag(), &balls.radius_m[i]);
    left |= not_free(asked.grid, moved(X, balls, i), radius, margin) << i;
  }
  return left;
}

HWY_INLINE bool has_near_point(const Asked& asked, const LinkPlace& X, std::size_t l,
                               const EightBalls& points) {
  const float limit_m = asked.margin_m(l) - asked.near_rounding_m;
  if (!(limit_m > 0)) return false;
  for (int i = 0; i < 8; i += kWidth) {
    if (near_points(asked.grid, moved(X, points, i), limit_m) != 0) return true;
  }
  return false;
}

/// A part of a straight line, by its middle and half of its length.
struct Part {
  double at = 0, half = 0;
};

/// Fine balls that are not free.
struct Left {
  std::size_t link;
  std::size_t coarse;
  unsigned fine;
};

Verdict check_one(const Asked& asked) {
  constexpr std::size_t kMostLeft = 64;
  Left left[kMostLeft];
  std::size_t count = 0;
  bool is_full = false;
  const std::vector<BallLink>& links = asked.request.robot.links;
  for (std::size_t l = 0; l < links.size(); ++l) {
    if (std::isnan(asked.margin_m(l))) continue;
    const LinkBalls& balls = links[l].balls;
    const LinkPlace X = place_of(asked.poses[links[l].frame], asked.lane);
    for (unsigned open = not_free(asked, X, l, balls.coarse); open != 0; open &= open - 1) {
      const auto coarse = static_cast<std::size_t>(__builtin_ctz(open));
      const unsigned fine = not_free(asked, X, l, balls.fine[coarse]);
      if (fine == 0) continue;
      if (has_near_point(asked, X, l, balls.coarse_points[coarse])) return Verdict::near;
      if (count < kMostLeft) {
        left[count++] = {l, coarse, fine};
      } else {
        is_full = true;
      }
    }
  }
  if (count == 0 && !is_full) return Verdict::free;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [l, coarse, fine] = left[i];
    const LinkPlace X = place_of(asked.poses[links[l].frame], asked.lane);
    for (unsigned open = fine; open != 0; open &= open - 1) {
      const EightBalls& points = links[l].balls.fine_points[coarse][__builtin_ctz(open)];
      if (has_near_point(asked, X, l, points)) return Verdict::near;
    }
  }
  // The search is asked where nothing else is undecided.
  const auto is_first = [&](const Left& one) {
    return asked.request.robot.is_first(links[one.link]);
  };
  if (!asked.asks_first || is_full || !std::all_of(left, left + count, is_first)) {
    return Verdict::undecided;
  }
  bool is_free = true;
  for (std::size_t i = 0; i < count; ++i) {
    const LinkBounds exact = asked.first_link_bounds(left[i].link);
    if (exact.upper_m <= asked.margin_m(left[i].link) - kNearRounding_m) return Verdict::near;
    is_free = is_free && exact.lower_m > asked.needed_m(left[i].link);
  }
  return is_free ? Verdict::free : Verdict::undecided;
}

/// Whether each ball of a is farther from each ball of b than the margin: the balls of b that are
/// not so from ball i of a.
HWY_INLINE unsigned not_apart(const EightBalls& a_B, std::size_t i, const EightBalls& b_B,
                              float margin_m) {
  unsigned left = 0;
  if (a_B.radius_m[i] < 0) return 0;
  const Tag d;
  for (int k = 0; k < 8; k += kWidth) {
    const Floats x = hn::Sub(hn::Load(d, &b_B.x_m[k]), all(a_B.x_m[i]));
    const Floats y = hn::Sub(hn::Load(d, &b_B.y_m[k]), all(a_B.y_m[i]));
    const Floats z = hn::Sub(hn::Load(d, &b_B.z_m[k]), all(a_B.z_m[i]));
    const Floats radius = hn::Load(d, &b_B.radius_m[k]);
    const Floats need = hn::Add(radius, all(a_B.radius_m[i] + margin_m));
    const auto is_apart =
        hn::Gt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))), hn::Mul(need, need));
    left |= (kAllLanes & ~bits(hn::Or(is_apart, hn::Lt(radius, all(0.0f))))) << k;
  }
  return left;
}

HWY_INLINE EightBalls in_B(const LinkPlace& X, const EightBalls& balls) {
  EightBalls out;
  for (int i = 0; i < 8; i += kWidth) {
    const Places places = moved(X, balls, i);
    hn::Store(places.x, Tag(), &out.x_m[i]);
    hn::Store(places.y, Tag(), &out.y_m[i]);
    hn::Store(places.z, Tag(), &out.z_m[i]);
  }
  out.radius_m = balls.radius_m;
  return out;
}

/// Whether a point of a is no farther from one of b than this.
HWY_INLINE bool have_near_points(const EightBalls& a_B, const EightBalls& b_B, float limit_m) {
  if (!(limit_m > 0)) return false;
  for (std::size_t i = 0; i < 8; ++i) {
    if (not_apart(a_B, i, b_B, limit_m) != 0) return true;
  }
  return false;
}

/// Two links that move.
Verdict check_pair(const Asked& asked, std::size_t a, std::size_t b) {
  const BallLink &own = asked.request.robot.links[a], &other = asked.request.robot.links[b];
  const float margin_m = asked.request.pairs_margin_m, near_m = margin_m - 2 * kNearRounding_m;
  const auto moves_m = [&](std::size_t l) {
    return asked.moves_m ? (*asked.moves_m)[l].of[asked.lane] : 0;
  };
  const float needed_m = margin_m + moves_m(a) + moves_m(b) + 2 * kFreeRounding_m;
  const LinkPlace X_a = place_of(asked.poses[own.frame], asked.lane);
  const LinkPlace X_b = place_of(asked.poses[other.frame], asked.lane);
  const EightBalls a_B = in_B(X_a, own.balls.coarse), b_B = in_B(X_b, other.balls.coarse);
  bool is_free = true;
  for (std::size_t i = 0; i < 8; ++i) {
    for (unsigned open = not_apart(a_B, i, b_B, needed_m); open != 0; open &= open - 1) {
      const auto k = static_cast<std::size_t>(__builtin_ctz(open));
      const EightBalls fine_a = in_B(X_a, own.balls.fine[i]),
                       fine_b = in_B(X_b, other.balls.fine[k]);
      for (std::size_t m = 0; m < 8; ++m) {
        for (unsigned left = not_apart(fine_a, m, fine_b, needed_m); left != 0; left &= left - 1) {
          is_free = false;
          const EightBalls& points = other.balls.fine_points[k][__builtin_ctz(left)];
          if (have_near_points(in_B(X_a, own.balls.fine_points[i][m]), in_B(X_b, points), near_m)) {
            return Verdict::near;
          }
        }
      }
    }
  }
  return is_free ? Verdict::free : Verdict::undecided;
}

/// All pairs of one configuration.
Verdict check_pairs(const Asked& asked) {
  const BallPairs& pairs = *asked.request.pairs;
  Verdict all_pairs = std::ranges::find(pairs.others, true) == pairs.others.end()
                          ? Verdict::free
                          : Verdict::undecided;
  for (std::size_t i = 0; i < pairs.still.size(); ++i) {
    const ClearanceField::Grid grid = pairs.still[i]->field.grid();
    Asked still{asked.request,
                grid,
                asked.request.still_margins_m[i],
                kNearRounding_m + kMeshPoint_m,
                asked.poses,
                asked.joints,
                asked.lane,
                asked.moves_m,
                false};
    const Verdict one = check_one(still);
    if (one == Verdict::near) return one;
    if (one == Verdict::undecided) all_pairs = one;
  }
  for (const auto& [a, b] : pairs.moved) {
    const Verdict one = check_pair(asked, a, b);
    if (one == Verdict::near) return one;
    if (one == Verdict::undecided) all_pairs = one;
  }
  return all_pairs;
}

/// What cameras see, then the pairs.
Verdict check_everything(const Asked& asked) {
  const Verdict seen = check_one(asked);
  if (seen == Verdict::near || !asked.request.pairs) return seen;
  const Verdict pairs = check_pairs(asked);
  return pairs == Verdict::free ? seen : pairs;
}

/// Of a thread; it grows to what its largest robot needs.
struct Scratch {
  std::vector<EightPoses> poses;
  /// Of each frame, and of each link.
  std::vector<EightNumbers> joints, moves_m;
  std::vector<Part> open;
};

Scratch& scratch_for(const BallRobot& robot) {
  thread_local Scratch scratch;
  scratch.poses.resize(robot.frames.size());
  scratch.joints.resize(robot.frames.size());
  scratch.moves_m.resize(robot.links.size());
  return scratch;
}

Asked asked_of(const BallRequest& request, const Scratch& scratch, std::size_t lane,
               const std::vector<EightNumbers>* moves_m) {
  return {request,
          request.grid,
          request.margins_m,
          kNearRounding_m,
          scratch.poses,
          scratch.joints,
          static_cast<int>(lane),
          moves_m,
          static_cast<bool>(request.first_link_bounds)};
}

/// What a joint does to a frame: an angle near 0, as floats are finest there.
float number_of(const BallFrame& frame, double position) {
  const double at = frame.multiplier * position + frame.offset;
  return static_cast<float>(frame.is_slide ? at : std::remainder(at, 2 * std::numbers::pi));
}

void check_all(const BallRequest& request, std::span<const double> positions,
               std::span<Verdict> out) {
  const BallRobot& robot = request.robot;
  Scratch& scratch = scratch_for(robot);
  const auto count = static_cast<std::size_t>(robot.joint_count);
  for (std::size_t first = 0; first < out.size(); first += 8) {
    const std::size_t lanes = std::min<std::size_t>(8, out.size() - first);
    for (std::size_t f = 0; f < robot.frames.size(); ++f) {
      for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t which = first + std::min(i, lanes - 1);
        const double position = positions[which * count + robot.frames[f].joint];
        scratch.joints[f].of[i] = number_of(robot.frames[f], position);
      }
    }
    place_frames(robot, scratch.joints, scratch.poses);
    for (std::size_t i = 0; i < lanes; ++i) {
      out[first + i] = check_everything(asked_of(request, scratch, i, nullptr));
    }
  }
}

/// How far each link's points come at most while each joint moves by a share of its step, from the
/// eight poses on. The joints may be moved one after another, from the root on: each turns what
/// hangs on it as it stands, since those behind it have not moved yet.
void find_moves(const BallRobot& robot, std::span<const double> from, std::span<const double> to,
                const std::vector<EightPoses>& poses, const float (&share)[8],
                std::vector<EightNumbers>& out) {
  for (std::size_t l = 0; l < robot.links.size(); ++l) {
    const LinkBalls& balls = robot.links[l].balls;
    const EightPoses& X = poses[robot.links[l].frame];
    for (std::size_t i = 0; i < 8; ++i) {
      const auto turned = [&](const EightPoses& of, const Eigen::Vector3f& v) {
        Eigen::Vector3f out_v;
        for (int k = 0; k < 3; ++k) {
          out_v[k] =
              of.m[3 * k][i] * v.x() + of.m[3 * k + 1][i] * v.y() + of.m[3 * k + 2][i] * v.z();
        }
        return out_v;
      };
      const auto origin = [&](const EightPoses& of) {
        return Eigen::Vector3f(of.m[9][i], of.m[10][i], of.m[11][i]);
      };
      const Eigen::Vector3f centre_B_m = turned(X, balls.centre_m) + origin(X);
      float sum_m = 0;
      for (int f = robot.links[l].frame; f >= 0; f = robot.frames[f].parent) {
        const BallFrame& frame = robot.frames[f];
        const auto step =
            static_cast<float>(std::abs(frame.multiplier * (to[frame.joint] - from[frame.joint])));
        float lever_m = 1;
        if (!frame.is_slide) {
          const Eigen::Vector3f axis_B =
              frame.parent < 0 ? frame.axis : turned(poses[frame.parent], frame.axis);
          constexpr float kRounding_m = 1e-4f;
          lever_m =
              (centre_B_m - origin(poses[f])).cross(axis_B).norm() + balls.radius_m + kRounding_m;
        }
        sum_m += step * lever_m;
      }
      out[l].of[i] = sum_m * share[i];
    }
  }
}

Verdict check_line(const BallRequest& request, std::span<const double> from,
                   std::span<const double> to, float least_step) {
  constexpr double kFirstParts = 8, kFirstStep = 0.05;
  constexpr std::size_t kMostOpen = 4000;
  const BallRobot& robot = request.robot;
  Scratch& scratch = scratch_for(robot);
  double longest = 0;
  for (std::size_t j = 0; j < from.size(); ++j)
    longest = std::max(longest, std::abs(to[j] - from[j]));
  const double parts = std::clamp(std::ceil(longest / kFirstStep), 1.0, kFirstParts);
  scratch.open.clear();
  for (double i = 0; i < parts; ++i) scratch.open.push_back({(i + 0.5) / parts, 0.5 / parts});
  bool is_free = true;
  while (!scratch.open.empty() && scratch.open.size() < kMostOpen) {
    const std::size_t lanes = std::min<std::size_t>(8, scratch.open.size());
    Part part[8];
    float share[8] = {};
    for (std::size_t i = 0; i < 8; ++i) {
      part[i] = i < lanes ? scratch.open[scratch.open.size() - 1 - i] : part[0];
      share[i] = static_cast<float>(part[i].half * (1 + 1e-5));
      for (std::size_t f = 0; f < robot.frames.size(); ++f) {
        const auto j = static_cast<std::size_t>(robot.frames[f].joint);
        scratch.joints[f].of[i] =
            number_of(robot.frames[f], from[j] + part[i].at * (to[j] - from[j]));
      }
    }
    scratch.open.resize(scratch.open.size() - lanes);
    place_frames(robot, scratch.joints, scratch.poses);
    find_moves(robot, from, to, scratch.poses, share, scratch.moves_m);
    for (std::size_t i = 0; i < lanes; ++i) {
      const Verdict one = check_everything(asked_of(request, scratch, i, &scratch.moves_m));
      if (one == Verdict::near) return one;
      if (one == Verdict::free) continue;
      if (part[i].half * longest < least_step) {
        is_free = false;
        continue;
      }
      const double half = part[i].half / 2;
      scratch.open.push_back({part[i].at - half, half});
      scratch.open.push_back({part[i].at + half, half});
    }
  }
  return is_free && scratch.open.empty() ? Verdict::free : Verdict::undecided;
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::mesh {

HWY_EXPORT(check_all);
HWY_EXPORT(check_line);

void check_configurations(const BallRequest& request, std::span<const double> positions,
                          std::span<Verdict> out) {
  HWY_DYNAMIC_DISPATCH(check_all)(request, positions, out);
}

Verdict check_motion(const BallRequest& request, std::span<const double> from,
                     std::span<const double> to, float least_step) {
  return HWY_DYNAMIC_DISPATCH(check_line)(request, from, to, least_step);
}

}  // namespace berth::mesh
#endif  // HWY_ONCE
