#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace berth::mesh {

/// A patch of a link and a piece of space, and a distance that no two of their points go below.
struct Item {
  float bound_m = 0;
  /// Among cubes the whole link is meant, and this is a leaf that may be near.
  std::uint32_t patch = 0;
  std::uint64_t space = 0;
  /// The children that were not gone into, one bit each: they are what the item stands for.
  std::uint64_t left = ~std::uint64_t{0};
  /// Of each search's own: how the item is taken apart.
  std::uint32_t way = 0;
};

/// Items that are still to be searched, the least bound first. Vector code of all instruction sets
/// uses it, so that nothing here is a template.
class ItemHeap {
 public:
  void clear() { items_.clear(); }
  void reserve(std::size_t count) { items_.reserve(count); }
  bool empty() const { return items_.empty(); }
  float least_bound_m() const {
    return empty() ? std::numeric_limits<float>::infinity() : items_[0].bound_m;
  }
  void push(const Item& item);
  Item pop();
  const std::vector<Item>& items() const { return items_; }

 private:
  std::vector<Item> items_;
};

/// What a search left aside since something else was nearer. From request to request all of space
/// stays in it: a request goes on where the one before ended. A link that moves by d comes nearer
/// to anything by d at most, so that all bounds fall alike, and are told less the sum of all d.
class Front {
 public:
  void clear();
  void reserve(std::size_t count) {
    level_m_.reserve(count);
    items_.reserve(count);
    below_.reserve(count);
  }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  /// How far the link has moved since clear(), at most.
  float drift_m() const { return drift_m_; }
  void move(float moved_m) { drift_m_ += moved_m; }
  void put(const Item& item);
  /// The items whose bounds are below the limit by now, the last one first: so the places that come
  /// after one in this list stay as they are when that one is taken. Valid until the next call.
  const std::vector<std::uint32_t>& find_below(float limit_m);
  const Item& item(std::uint32_t place) const { return items_[place]; }
  /// Of the item by now.
  float bound_m(std::uint32_t place) const { return level_m_[place] - drift_m_; }
  /// It is known to be at least so far away.
  void raise(std::uint32_t place, float bound_m) {
    level_m_[place] = std::max(level_m_[place], level_of(bound_m));
  }
  /// Moves an item to the heap.
  void take(std::uint32_t place, ItemHeap& heap);
  /// Moves all items whose bounds are below the limit by now to the heap.
  void take_below(float limit_m, ItemHeap& heap);

 private:
  float level_of(float bound_m) const {
    // Both sums round by less than a bound is worth.
    constexpr float kRounding_m = 1e-6f;
    return bound_m + drift_m_ - kRounding_m;
  }

  float drift_m_ = 0;
  /// The items' bounds plus the drift when they were put here.
  std::vector<float> level_m_;
  std::vector<Item> items_;
  std::vector<std::uint32_t> below_;
};

}  // namespace berth::mesh
