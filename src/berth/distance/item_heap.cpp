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
  level_m_.push_back(level_of(item.bound_m));
  items_.push_back(item);
}

const std::vector<std::uint32_t>& Front::find_below(float limit_m) {
  const float level_m = limit_m + drift_m_;
  below_.clear();
  for (std::size_t i = items_.size(); i-- > 0;) {
    if (level_m_[i] < level_m) below_.push_back(static_cast<std::uint32_t>(i));
  }
  return below_;
}

void Front::take(std::uint32_t place, ItemHeap& heap) {
  Item item = items_[place];
  item.bound_m = level_m_[place] > drift_m_ ? level_m_[place] - drift_m_ : 0;
  heap.push(item);
  level_m_[place] = level_m_.back();
  items_[place] = items_.back();
  level_m_.pop_back();
  items_.pop_back();
}

void Front::take_below(float limit_m, ItemHeap& heap) {
  for (const std::uint32_t place : find_below(limit_m)) take(place, heap);
}

}  // namespace berth::mesh
