#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace berth::mesh {

/// A patch of a link and a piece of space, and a distance that no two of their points go below.
struct Item {
  float bound_m;
  /// Among cubes the whole link is meant, and this is a leaf that may be near.
  std::uint32_t patch;
  std::uint64_t space;
};

/// What is still to be searched, the least bound first. Vector code of all instruction sets uses
/// it, so that nothing here is a template.
class ItemHeap {
 public:
  void clear() { items_.clear(); }
  bool empty() const { return items_.empty(); }
  float least_bound_m() const {
    return empty() ? std::numeric_limits<float>::infinity() : items_[0].bound_m;
  }
  void push(const Item& item);
  Item pop();

 private:
  std::vector<Item> items_;
};

}  // namespace berth::mesh
