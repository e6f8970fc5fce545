#include "berth/distance/link_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>

namespace berth::mesh {
namespace {

/// A grid of edge e at distance d says at most e^2 3 / (8 d) too little: what a trilinear function
/// between squares of distances may lack in the middle of a cell.
struct Size {
  float edge_m;
  /// For points up to so far from the link.
  float up_to_m;
};
constexpr Size kSizes[] = {{0.008f, 0.4f}, {0.016f, 0.7f}, {0.032f, 1.2f}};

/// A point that is asked for is about as far as was thought.
constexpr float kMargin_m = 0.05f;

}  // namespace

void FieldGrid::place(float edge_m, const Eigen::Vector3f& low_L_m,
                      const Eigen::Vector3f& high_L_m) {
  edge_m_ = edge_m;
  low_L_m_ = low_L_m;
  reach_m_ = low_L_m.cwiseAbs().cwiseMax(high_L_m.cwiseAbs()).norm() + 2 * edge_m;
  for (int k = 0; k < 3; ++k) {
    count_[k] = static_cast<std::size_t>(std::ceil((high_L_m[k] - low_L_m[k]) / edge_m)) + 2;
  }
}

FieldGrid::~FieldGrid() { std::free(points_m2_.load()); }

float* FieldGrid::begin() const {
  auto* const mine =
      static_cast<float*>(std::calloc(count_[0] * count_[1] * count_[2], sizeof(float)));
  if (!mine) throw std::bad_alloc();
  float* others = nullptr;
  if (points_m2_.compare_exchange_strong(others, mine)) return mine;
  std::free(mine);
  return others;
}

bool FieldGrid::cell_of(const Eigen::Vector3f& p_L_m, std::array<int, 3>& cell,
                        Eigen::Vector3f& place) const {
  const Eigen::Vector3f at = (p_L_m - low_L_m_) / edge_m_;
  for (int k = 0; k < 3; ++k) {
    if (!(at[k] >= 0 && at[k] < static_cast<float>(count_[k] - 1))) return false;
    cell[k] = static_cast<int>(at[k]);
    place[k] = at[k] - static_cast<float>(cell[k]);
  }
  return true;
}

LinkField::LinkField(const std::array<std::vector<float>, 9>& corners_m) {
  Eigen::Vector3f low_L_m, high_L_m;
  for (std::size_t k = 0; k < 3; ++k) {
    low_L_m[k] = high_L_m[k] = corners_m[k].front();
    for (const std::size_t corner : {k, k + 3, k + 6}) {
      const auto [low, high] = std::ranges::minmax(corners_m[corner]);
      low_L_m[k] = std::min(low_L_m[k], low);
      high_L_m[k] = std::max(high_L_m[k], high);
    }
  }
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const auto reach_m = Eigen::Vector3f::Constant(kSizes[i].up_to_m + kMargin_m);
    grids_[i].place(kSizes[i].edge_m, low_L_m - reach_m, high_L_m + reach_m);
  }
}

const FieldGrid* LinkField::grid_for(float distance_m) const {
  if (!(distance_m >= kNearest_m)) return nullptr;
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    if (distance_m < kSizes[i].up_to_m) return &grids_[i];
  }
  return nullptr;
}

}  // namespace berth::mesh
