#pragma once

#include <cassert>

#include "berth/distance/obstacle_tree.hpp"

namespace berth {

/// An image of what may be an obstacle and the tree over it, so that no image is ever asked with
/// the tree of another one. It looks at the image, which has to stay where and as it is. It moves,
/// but does not copy: the copy of who owns both would look at the other's image.
class SearchableDepth {
 public:
  SearchableDepth() = default;
  /// Without a tree: enough for brute_force and lattice.
  explicit SearchableDepth(DepthView depth_m) : depth_m_(depth_m) {}
  SearchableDepth(SearchableDepth&&) = default;
  SearchableDepth& operator=(SearchableDepth&&) = default;

  /// Builds the tree of another image; reuses its memory.
  void build(DepthView depth_m) {
    depth_m_ = depth_m;
    build_obstacle_tree(depth_m, tree_);
  }

  DepthView depth_m() const { return depth_m_; }
  /// Once it is built.
  const ObstacleTree& tree() const {
    assert(tree_.level_count > 0);
    return tree_;
  }

 private:
  DepthView depth_m_;
  ObstacleTree tree_;
};

}  // namespace berth
