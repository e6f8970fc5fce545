#include "berth/distance/item_heap.hpp"

#include <algorithm>

namespace berth::mesh {
namespace {

constexpr auto is_later = [](const Item& a, const Item& b) { return a.bound_m > b.bound_m; };

}  // namespace

void ItemHeap::push(const Item& item) {
  items_.push_back(item);
  std::push_heap(items_.begin(), items_.end(), is_later);
}

Item ItemHeap::pop() {
  std::pop_heap(items_.begin(), items_.end(), is_later);
  const Item item = items_.back();
  items_.pop_back();
  return item;
}

void Front::clear() {
  drift_m_ = 0;
  level_m_.clear();
  items_.clear();
}

void Front::put(const Item& item) {
  // Both sums round by less than a bound is worth.
  constexpr float kRounding_m = 1e-6f;
  level_m_.push_back(item.bound_m + drift_m_ - kRounding_m);
  items_.push_back(item);
}

void Front::take_below(float limit_m, ItemHeap& heap) {
  const float level_m = limit_m + drift_m_;
  for (std::size_t i = 0; i < items_.size();) {
    if (!(level_m_[i] < level_m)) {
      ++i;
      continue;
    }
    Item item = items_[i];
    item.bound_m = level_m_[i] > drift_m_ ? level_m_[i] - drift_m_ : 0;
    heap.push(item);
    level_m_[i] = level_m_.back();
    items_[i] = items_.back();
    level_m_.pop_back();
    items_.pop_back();
  }
}

}  // namespace berth::mesh
