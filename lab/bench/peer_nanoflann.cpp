// nanoflann: a KD-tree over the obstacle points, built for each frame and asked for every robot
// pixel.
#include <cmath>
#include <nanoflann.hpp>

#include "lab/bench/closest_so_far.hpp"
#include "lab/bench/peer.hpp"
#include "lab/bench/points.hpp"

namespace berth::lab {
namespace {

/// The fastest of those tried: 10, 15, 32, 64.
constexpr std::size_t kLeafPoints = 32;

/// Points as nanoflann wants to see them.
struct PointCloud {
  std::vector<Point> points_C_m;

  std::size_t kdtree_get_point_count() const { return points_C_m.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points_C_m[i][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

class NanoflannPeer : public Peer {
 public:
  std::string name() const override { return "nanoflann KD-tree"; }
  std::string lacks() const override { return "gray area, pixel sizes"; }

  void prepare(const BenchScene& scene) override {
    collect_obstacle_points(scene, cloud_.points_C_m);
    tree_.buildIndex();
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    collect_robot_points(scene, robot_C_m_);
    distances_m.clear();
    const auto range_m = static_cast<float>(scene.range_m);
    for (const std::vector<Point>& link : robot_C_m_) {
      ClosestSoFar closest{range_m * range_m};
      for (const Point& p : link) tree_.findNeighbors(closest, p.data(), nanoflann::SearchParams());
      distances_m.push_back(closest.found ? std::optional(std::sqrt(closest.squared_m2))
                                          : std::nullopt);
    }
  }

 private:
  using Metric = nanoflann::L2_Simple_Adaptor<float, PointCloud>;

  PointCloud cloud_;
  nanoflann::KDTreeSingleIndexAdaptor<Metric, PointCloud, 3> tree_{
      3, cloud_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafPoints)};
  std::vector<std::vector<Point>> robot_C_m_;
};

}  // namespace

std::unique_ptr<Peer> make_nanoflann() { return std::make_unique<NanoflannPeer>(); }

}  // namespace berth::lab
