#include "berth/space/box_distances.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "berth/space/box_distances.cpp"
#include "hwy/foreach_target.h"

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace berth {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Signed: the oldest instruction sets have the lesser of two such numbers alone.
using Tag = hn::CappedTag<std::int16_t, 32>;
using Squares = hn::Vec<Tag>;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(Tag()));
constexpr int kRangeBoxes = BoxDistances::kRangeBoxes;
constexpr std::int16_t kMost = kRangeBoxes * kRangeBoxes;
/// In cells.
constexpr int kReach = (kRangeBoxes + 1) / 4;
constexpr double kNear = kReach + 2;

/// The squares of the distances of boxes that lie k cells beside a node: those of a cell of which
/// the first is nearest, and of one of which the last is.
struct Beside {
  alignas(64) std::int16_t ahead[kReach][32];
  alignas(64) std::int16_t behind[kReach][32];
};
constexpr Beside kBeside = [] {
  Beside out{};
  for (int k = 0; k < kReach; ++k) {
    for (int i = 0; i < 32; ++i) {
      const int first = 4 * k + i % 4, last = 4 * k + 3 - i % 4;
      out.ahead[k][i] = static_cast<std::int16_t>(first * first);
      out.behind[k][i] = static_cast<std::int16_t>(last * last);
    }
  }
  return out;
}();

/// Where an axis has numbers for four boxes of each cell, side by side, and nodes at the cells'
/// ends: the cells' rows from a node on, and before it; null where nothing is near.
struct Rows {
  const std::int16_t* ahead[kReach];
  const std::int16_t* behind[kReach];
};

/// Writes the least of square and number to the place i / 4 of each four, from begin to end; both
/// are multiples of the width.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void find_nearest(const Rows& rows, int begin, int end, std::uint16_t* out) {
  for (int i = begin; i < end; ++i) {
    int least = i % 4 == 0 ? kMost : out[i / 4];
    for (int k = 0; k < kReach; ++k) {
      if (rows.ahead[k]) least = std::min(least, rows.ahead[k][i] + kBeside.ahead[k][i % 4]);
      if (rows.behind[k]) least = std::min(least, rows.behind[k][i] + kBeside.behind[k][i % 4]);
    }
    out[i / 4] = static_cast<std::uint16_t>(least);
  }
}
#else
HWY_INLINE void find_nearest(const Rows& rows, int begin, int end, std::uint16_t* out) {
  const Tag d;
  const hn::Repartition<std::uint64_t, Tag> fours;
  for (int i = begin; i < end; i += kWidth) {
    Squares least = hn::Set(d, kMost);
    for (int k = 0; k < kReach; ++k) {
      const auto nearer = static_cast<std::int16_t>(16 * k * k);
      if (hn::AllFalse(d, hn::Gt(least, hn::Set(d, nearer)))) break;
      const auto take = [&](const std::int16_t* row, const std::int16_t* square) HWY_ATTR {
        if (row) least = hn::Min(least, hn::Add(hn::LoadU(d, row + i), hn::Load(d, square)));
      };
      take(rows.ahead[k], kBeside.ahead[k]);
      take(rows.behind[k], kBeside.behind[k]);
    }
    least = hn::Min(least, hn::Reverse2(d, least));
    least = hn::Min(least, hn::Reverse4(d, least));
    const hn::Rebind<std::uint16_t, decltype(fours)> narrow;
    hn::StoreU(hn::TruncateTo(narrow, hn::BitCast(fours, least)), narrow, out + i / 4);
  }
}
#endif

/// Of a row of cells the squares of the distances along x to the nearest box, for each of its 16
/// rows of boxes, at each node. Returns whether there is one.
#if HWY_TARGET == HWY_SCALAR
HWY_INLINE bool find_along_x(const std::uint64_t* boxes, BoxGrid::Row row, int count,
                             std::uint8_t* /*ahead*/, std::int16_t* out) {
  std::fill(out, out + 16 * count, kMost);
  for (int i = 0; i < 16; ++i) {
    for (const bool is_upwards : {true, false}) {
      int apart = kRangeBoxes;
      for (int n = 4 * row.begin; n < 4 * row.end; ++n) {
        const int box = is_upwards ? n : 4 * (row.end + row.begin) - 1 - n;
        std::int16_t& at = out[4 * box + i];
        if (is_upwards && box % 4 == 0) at = std::min(at, static_cast<std::int16_t>(apart * apart));
        apart =
            (boxes[box / 4] >> (4 * i + box % 4) & 1) != 0 ? 0 : std::min(apart + 1, kRangeBoxes);
        if (!is_upwards && box % 4 == 0) {
          at = std::min(at, static_cast<std::int16_t>(apart * apart));
        }
      }
    }
  }
  return true;
}
#else
HWY_INLINE bool find_along_x(const std::uint64_t* boxes, BoxGrid::Row row, int count,
                             std::uint8_t* ahead, std::int16_t* out) {
  const hn::FixedTag<std::uint8_t, 16> d;
  const hn::FixedTag<std::uint8_t, 8> half;
  const hn::FixedTag<std::uint64_t, 2> words;
  const hn::FixedTag<std::int16_t, 8> d16;
  // By four boxes' bits: how many lie before the first, and behind the last.
  alignas(16) static constexpr std::uint8_t kFirst[16] = {kRangeBoxes, 0, 1, 0, 2, 0, 1, 0,
                                                          3,           0, 1, 0, 2, 0, 1, 0};
  alignas(16) static constexpr std::uint8_t kLast[16] = {kRangeBoxes, 3, 2, 2, 1, 1, 1, 1,
                                                         0,           0, 0, 0, 0, 0, 0, 0};
  const auto first = hn::Load(d, kFirst), last = hn::Load(d, kLast);
  const auto most = hn::Set(d, std::uint8_t{kRangeBoxes}), four = hn::Set(d, std::uint8_t{4});
  const auto fours_of = [&](int x) HWY_ATTR {
    const auto word = hn::BitCast(d, hn::Set(words, boxes[x]));
    const auto low = hn::And(word, hn::Set(d, std::uint8_t{15}));
    const auto high = hn::And(
        hn::BitCast(d, hn::ShiftRight<4>(hn::BitCast(hn::FixedTag<std::uint16_t, 8>(), word))),
        hn::Set(d, std::uint8_t{15}));
    return hn::InterleaveLower(d, low, high);
  };
  auto apart = most;
  const auto pass = [&](decltype(most) of_cell)
                        HWY_ATTR { apart = hn::Min(hn::Min(of_cell, hn::Add(apart, four)), most); };
  auto least = most;
  for (int x = row.end - 1; x >= row.begin; --x) {
    pass(hn::TableLookupBytes(first, fours_of(x)));
    hn::Store(apart, d, ahead + 16 * x);
    least = hn::Min(least, apart);
  }
  if (hn::AllTrue(d, hn::Eq(least, most))) return false;
  std::fill(out, out + 16 * row.begin, kMost);
  std::fill(out + 16 * row.end, out + 16 * count, kMost);
  apart = most;
  for (int x = row.begin; x < row.end; ++x) {
    const auto here = hn::Min(apart, hn::Load(d, ahead + 16 * x));
    const auto low = hn::PromoteTo(d16, hn::LowerHalf(half, here));
    const auto high = hn::PromoteTo(d16, hn::UpperHalf(half, here));
    hn::StoreU(hn::Mul(low, low), d16, out + 16 * x);
    hn::StoreU(hn::Mul(high, high), d16, out + 16 * x + 8);
    pass(hn::TableLookupBytes(last, fours_of(x)));
  }
  return true;
}
#endif

/// In whole vectors of four rows of boxes.
HWY_INLINE BoxGrid::Row widened(BoxGrid::Row row) {
  constexpr int kTo = BoxGrid::kRow - 1;
  return {row.begin & ~kTo, (row.end + kTo) & ~kTo};
}

void find_along_xy(const BoxGrid& grid, int z, std::int16_t* out) {
  thread_local std::vector<std::int16_t> along_x;
  thread_local std::vector<std::uint8_t> ahead;
  const auto [columns, rows, layers] = grid.count;
  const auto length = static_cast<std::size_t>(16) * columns;
  along_x.resize(length * rows);
  ahead.resize(length);
  std::vector<const std::int16_t*> of_row(rows, nullptr);
  for (int y = 0; y < rows; ++y) {
    const BoxGrid::Row row = grid.in_ball(kNear, y + 0.5, z + 0.5);
    const std::uint64_t* const boxes =
        grid.boxes + (static_cast<std::size_t>(z) * rows + y) * columns;
    std::int16_t* const at = &along_x[length * y];
    if (row.begin < row.end && find_along_x(boxes, row, columns, ahead.data(), at)) of_row[y] = at;
  }
  // The nodes that are asked about may stand in any layer within reach.
  const double beside = z + 0.5 - grid.middle.z();
  const double least = std::copysign(std::max(0.0, std::abs(beside) - kReach), beside);
  for (int y = 0; y < rows; ++y) {
    const BoxGrid::Row row = widened(grid.in_ball(0, y, grid.middle.z() + least));
    Rows near{};
    for (int k = 0; k < kReach; ++k) {
      near.ahead[k] = y + k < rows ? of_row[y + k] : nullptr;
      near.behind[k] = y - 1 - k >= 0 ? of_row[y - 1 - k] : nullptr;
    }
    auto* const to =
        reinterpret_cast<std::uint16_t*>(out + static_cast<std::size_t>(4) * y * columns);
    find_nearest(near, 16 * row.begin, 16 * row.end, to);
  }
}

void find_along_z(const BoxGrid& grid, int z, const std::int16_t* along_xy, std::uint16_t* out) {
  const auto [columns, rows, layers] = grid.count;
  for (int y = 0; y < rows; ++y, out += columns) {
    const BoxGrid::Row row = grid.in_ball(0, y, z), wide = widened(row);
    Rows near{};
    const auto at = [&](int layer) {
      return layer < 0 || layer >= layers
                 ? nullptr
                 : along_xy + 4 * ((static_cast<std::size_t>(layer) * rows + y) * columns);
    };
    for (int k = 0; k < kReach; ++k) near.ahead[k] = at(z + k), near.behind[k] = at(z - 1 - k);
    find_nearest(near, 4 * wide.begin, 4 * wide.end, out);
    // Of what is farther from the middle nothing is known.
    std::fill(out, out + row.begin, std::uint16_t{0});
    std::fill(out + row.end, out + columns, std::uint16_t{0});
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace berth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth {

HWY_EXPORT(find_along_xy);
HWY_EXPORT(find_along_z);

BoxGrid::Row BoxGrid::in_ball(double more, double y, double z) const {
  const double most = radius + more;
  const double square =
      most * most - (y - middle.y()) * (y - middle.y()) - (z - middle.z()) * (z - middle.z());
  if (square <= 0) return {};
  const double half = std::sqrt(square);
  return {std::max(0, static_cast<int>(middle.x() - half)),
          std::min(count[0], static_cast<int>(middle.x() + half) + 2)};
}

void BoxDistances::find(const BoxGrid& grid, std::vector<std::uint16_t>& squared) {
  const auto layer = static_cast<std::size_t>(grid.count[0]) * grid.count[1];
  along_xy_.resize(4 * layer * grid.count[2]);
  squared.resize(layer * grid.count[2] + 2);
  tbb::parallel_for(0, grid.count[2], [&](int z) {
    HWY_DYNAMIC_DISPATCH(find_along_xy)(grid, z, &along_xy_[4 * layer * z]);
  });
  tbb::parallel_for(0, grid.count[2], [&](int z) {
    HWY_DYNAMIC_DISPATCH(find_along_z)(grid, z, along_xy_.data(), &squared[layer * z]);
  });
}

}  // namespace berth
#endif  // HWY_ONCE
