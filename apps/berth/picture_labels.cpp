#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/berth/picture_pairs.hpp"

namespace berth::app {
namespace {

bool overlap(const BoxPx& a, const BoxPx& b, double gap_px) {
  return a.x < b.x + b.width + gap_px && b.x < a.x + a.width + gap_px &&
         a.y < b.y + b.height + gap_px && b.y < a.y + a.height + gap_px;
}

bool inside(const BoxPx& box, const BoxPx& bounds) {
  return box.x >= bounds.x && box.y >= bounds.y && box.x + box.width <= bounds.x + bounds.width &&
         box.y + box.height <= bounds.y + bounds.height;
}

int covered(const BoxPx& box, const std::vector<PointPx>& points) {
  int count = 0;
  for (const PointPx& p : points) count += overlap(box, {p.x, p.y, 0, 0}, 0.2 * box.height) ? 1 : 0;
  return count;
}

/// The candidates lie on rings that grow from the label's own shape, so that none hides the anchor.
BoxPx candidate(const LabelRequest& label, int ring, double angle) {
  const double margin = 0.7 * ring * label.height_px;
  const double x = label.anchor.x + (label.width_px / 2 + margin) * std::cos(angle);
  const double y = label.anchor.y + (label.height_px / 2 + margin) * std::sin(angle);
  return {x - label.width_px / 2, y - label.height_px / 2, label.width_px, label.height_px};
}

std::optional<BoxPx> cheapest_place(const LabelRequest& label, const BoxPx& bounds,
                                    const std::vector<PointPx>& avoid,
                                    const std::vector<std::optional<BoxPx>>& taken) {
  constexpr int kRings = 16, kDirections = 20;
  std::optional<BoxPx> best;
  double best_cost = 0;
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int k = 0; k < kDirections; ++k) {
      const BoxPx box = candidate(label, ring, 2 * std::numbers::pi * k / kDirections);
      const bool is_taken = std::ranges::any_of(taken, [&](const std::optional<BoxPx>& other) {
        return other && overlap(box, *other, 0.15 * label.height_px);
      });
      if (is_taken || !inside(box, bounds)) continue;
      const double cost = ring + 0.6 * covered(box, avoid);
      if (best && cost >= best_cost) continue;
      best = box;
      best_cost = cost;
    }
  }
  return best;
}

}  // namespace

std::vector<std::optional<BoxPx>> place_labels(const std::vector<LabelRequest>& requests,
                                               const BoxPx& bounds,
                                               const std::vector<PointPx>& avoid) {
  std::vector<std::optional<BoxPx>> placed;
  for (const LabelRequest& request : requests)
    placed.push_back(cheapest_place(request, bounds, avoid, placed));
  return placed;
}

}  // namespace berth::app
