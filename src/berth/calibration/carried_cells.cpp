#include "berth/calibration/carried_cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace berth {
namespace {

/// Cells belong to one piece where at most this number lies between them.
constexpr int kJoined = 3;
/// A view shows a piece where it shows this share of its cells.
constexpr double kFairShare = 0.05;
/// Smaller pieces may be noise: a cube of 3 cm has as many on its surface.
constexpr std::size_t kLeastCells = 200;
/// Places of a piece that lie nearer to each other are one.
constexpr double kOtherPlace_m = 0.04;
constexpr std::size_t kPieceSamples = 50;
/// Two neighbouring pixels show one surface up to this step, at 1 m.
constexpr float kEdgeJump_m = 0.015F;

/// The views in which the cell is seen as taken by what moves; empty where any sees it free.
std::vector<std::size_t> views_of(const Cell& cell, std::size_t link,
                                  const std::vector<EvidenceView>& views) {
  std::vector<std::size_t> seen_in;
  const Eigen::Vector3d p_L_m = middle_of(cell);
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Eigen::Vector3d p_B_m = views[k].pose.X_BL[link] * p_L_m;
    if (sees_free(views[k], p_B_m)) return {};
    if (sees_moving(views[k], p_B_m)) seen_in.push_back(k);
  }
  return seen_in;
}

/// Whether two of the views have the cell at places that cannot be one and the same.
bool is_at_two_places(const Cell& cell, std::size_t link, const std::vector<EvidenceView>& views,
                      const std::vector<std::size_t>& seen_in) {
  const Eigen::Vector3d p_L_m = middle_of(cell);
  for (const std::size_t a : seen_in) {
    for (const std::size_t b : seen_in) {
      if (b >= a) break;
      const double apart_m =
          (views[a].pose.X_BL[link] * p_L_m - views[b].pose.X_BL[link] * p_L_m).norm();
      if (apart_m > 2 * (views[a].uncertainty_m + views[b].uncertainty_m)) return true;
    }
  }
  return false;
}

struct ProvenCells {
  CellSet cells;
  /// By the cell's place in `cells`.
  std::vector<std::vector<std::size_t>> seen_in;
};

ProvenCells find_proven(const RigidGroup& group, const std::vector<EvidenceView>& views,
                        const std::vector<MovingReading>& readings) {
  CellSet candidates;
  for (const MovingReading& reading : readings) {
    if (reading.is_explained || !reading.is_left) continue;
    const Eigen::Vector3d p_L_m =
        views[reading.view].pose.X_BL[group.link].inverse() * reading.p_B_m;
    if (group.reach_L_m.contains(p_L_m)) candidates.insert(cell_of(p_L_m));
  }
  std::vector<std::vector<std::size_t>> seen_in(candidates.size());
  tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
    const Cell& cell = candidates.cells()[i];
    seen_in[i] = views_of(cell, group.link, views);
    if (!is_at_two_places(cell, group.link, views, seen_in[i])) seen_in[i].clear();
  });
  ProvenCells proven;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (seen_in[i].empty()) continue;
    proven.cells.insert(candidates.cells()[i]);
    proven.seen_in.push_back(std::move(seen_in[i]));
  }
  return proven;
}

/// The number of its piece of each cell, from 0.
std::vector<int> pieces_of(const CellSet& cells) {
  std::vector<int> piece(cells.size(), -1);
  std::vector<int> open;
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (piece[i] >= 0) continue;
    piece[i] = count;
    open.push_back(static_cast<int>(i));
    while (!open.empty()) {
      const Cell at = cells.cells()[static_cast<std::size_t>(open.back())];
      open.pop_back();
      each_cell_around(at, kJoined, [&](const Cell& beside) {
        const int j = cells.find(beside);
        if (j < 0 || piece[static_cast<std::size_t>(j)] >= 0) return;
        piece[static_cast<std::size_t>(j)] = count;
        open.push_back(j);
      });
    }
    ++count;
  }
  return piece;
}

std::vector<Eigen::Vector3d> sample_points(const CellSet& cells) {
  std::vector<Eigen::Vector3d> points;
  const std::size_t step = std::max<std::size_t>(1, cells.size() / kPieceSamples);
  for (std::size_t i = 0; i < cells.size(); i += step)
    points.push_back(middle_of(cells.cells()[i]));
  return points;
}

/// The mean way of the points from one pose of the link to another.
double mean_way_m(const std::vector<Eigen::Vector3d>& points_L_m, const Pose& X_BL_a,
                  const Pose& X_BL_b) {
  double sum_m = 0;
  for (const Eigen::Vector3d& p_L_m : points_L_m) sum_m += (X_BL_a * p_L_m - X_BL_b * p_L_m).norm();
  return sum_m / static_cast<double>(points_L_m.size());
}

void count_places(const std::vector<EvidenceView>& views, CarriedCells& piece) {
  const std::vector<Eigen::Vector3d> points_L_m = sample_points(piece.cells);
  std::vector<std::size_t> places;
  for (const std::size_t k : piece.seen_in) {
    const Pose& X_BL = views[k].pose.X_BL[piece.group.link];
    const auto way_m = [&](std::size_t other) {
      return mean_way_m(points_L_m, X_BL, views[other].pose.X_BL[piece.group.link]);
    };
    bool is_new = true;
    for (const std::size_t place : places) {
      is_new &= way_m(place) > kOtherPlace_m;
      piece.apart_m = std::max(piece.apart_m, way_m(place));
    }
    if (is_new) places.push_back(k);
  }
  piece.places = static_cast<int>(places.size());
}

/// Cells about those of the piece, within which a reading is one of its surface.
bool explains(const CarriedCells& piece, const Eigen::Vector3d& p_L_m) {
  bool is_near = false;
  each_cell_around(cell_of(p_L_m), 1,
                   [&](const Cell& beside) { is_near |= piece.cells.contains(beside); });
  return is_near;
}

int count_explained(const CarriedCells& piece, const std::vector<EvidenceView>& views,
                    const std::vector<MovingReading>& readings) {
  int count = 0;
  for (const MovingReading& reading : readings) {
    if (reading.is_explained || !reading.is_left) continue;
    count +=
        explains(piece, views[reading.view].pose.X_BL[piece.group.link].inverse() * reading.p_B_m);
  }
  return count;
}

bool is_at_edge(const DepthImage& depth_m, int u, int v) {
  const float z_m = depth_m(u, v);
  const float jump_m = kEdgeJump_m * std::max(1.0F, z_m * z_m);
  const PixelRect near = clip({u - 1, v - 1, u + 2, v + 2}, depth_m.width(), depth_m.height());
  for (int b = near.v_begin; b < near.v_end; ++b) {
    for (int a = near.u_begin; a < near.u_end; ++a) {
      if (!(std::abs(depth_m(a, b) - z_m) < jump_m)) return true;
    }
  }
  return false;
}

}  // namespace

bool CarriedCells::is_proven() const {
  return cells.size() >= kLeastCells && places >= kLeastRoomPlaces && apart_m > size_m;
}

std::vector<MovingReading> moving_readings(const std::vector<EvidenceView>& views) {
  std::vector<MovingReading> readings;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Image<ReadingKind>& kind = views[k].kind;
    for (int v = 0; v < kind.height(); ++v) {
      for (int u = 0; u < kind.width(); ++u) {
        if (kind(u, v) < ReadingKind::moving_beside) continue;
        readings.push_back({k, views[k].point_B_m(u, v), kind(u, v) == ReadingKind::moving,
                            is_at_edge(views[k].depth_m, u, v), false});
      }
    }
  }
  return readings;
}

std::vector<CarriedCells> find_carried_cells(const RigidGroup& group,
                                             const std::vector<EvidenceView>& views,
                                             const std::vector<MovingReading>& readings) {
  const ProvenCells proven = find_proven(group, views, readings);
  const std::vector<int> piece_of = pieces_of(proven.cells);
  std::vector<CarriedCells> pieces;
  std::vector<std::vector<int>> shown;  // by piece and view: how many cells
  for (std::size_t i = 0; i < proven.cells.size(); ++i) {
    const auto p = static_cast<std::size_t>(piece_of[i]);
    if (p == pieces.size()) {
      pieces.emplace_back().group = group;
      shown.emplace_back(views.size(), 0);
    }
    pieces[p].cells.insert(proven.cells.cells()[i]);
    for (const std::size_t k : proven.seen_in[i]) ++shown[p][k];
  }
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    CarriedCells& piece = pieces[p];
    if (piece.cells.size() < kLeastCells) continue;
    Eigen::AlignedBox3d box_L_m;
    for (const Cell& cell : piece.cells.cells()) box_L_m.extend(middle_of(cell));
    piece.size_m = box_L_m.sizes().maxCoeff();
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (shown[p][k] > kFairShare * static_cast<double>(piece.cells.size()))
        piece.seen_in.push_back(k);
    }
    count_places(views, piece);
    if (piece.is_proven()) piece.explains = count_explained(piece, views, readings);
  }
  std::erase_if(pieces, [](const CarriedCells& piece) { return !piece.is_proven(); });
  return pieces;
}

}  // namespace berth
