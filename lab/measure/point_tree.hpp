// nanoflann's k-d tree, of points that have their coordinates by [0], [1], [2].
#pragma once

#include <cstddef>
#include <nanoflann.hpp>
#include <vector>

namespace berth::lab {

template <class Point>
class PointTree {
 public:
  PointTree() = default;
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  /// Whoever changes them builds the tree before asking.
  std::vector<Point>& points_m() { return cloud_.points_m; }
  void build() { tree_.buildIndex(); }

  /// Hands the points beside a place of three numbers to what nanoflann calls a result set.
  template <class ResultSet>
  void find(const float* place_m, ResultSet& out) const {
    tree_.findNeighbors(out, place_m, nanoflann::SearchParams());
  }

 private:
  /// Points as nanoflann wants to see them.
  struct Cloud {
    std::vector<Point> points_m;

    std::size_t kdtree_get_point_count() const { return points_m.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points_m[i][axis]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  /// The fastest of those tried: 10, 15, 32, 64.
  static constexpr std::size_t kLeafPoints = 32;
  using Metric = nanoflann::L2_Simple_Adaptor<float, Cloud>;

  Cloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, Cloud, 3> tree_{
      3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPoints)};
};

}  // namespace berth::lab
