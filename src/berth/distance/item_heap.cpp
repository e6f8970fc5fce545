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

}  // namespace berth::mesh
