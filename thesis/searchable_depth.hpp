#pragma once

#include <cassert>

#include "thesis/obstacle_tree.hpp"

namespace berth {

/// An image of what may be an obstacle, together with its tree, so that no image is ever used with
/// the tree of another one. It refers to the image, which must neither change nor move. It can be
/// moved but not copied: a copy would still refer to the first one's image.
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
