// nanoflann: a KD-tree over the obstacle points, built for each frame and asked for every robot
// pixel.
#include <cmath>

#include "lab/bench/closest_so_far.hpp"
#include "lab/bench/peer.hpp"
#include "lab/bench/points.hpp"
#include "lab/measure/point_tree.hpp"

namespace berth::lab {
namespace {

class NanoflannPeer : public Peer {
 public:
  std::string name() const override { return "nanoflann KD-tree"; }
  std::string lacks() const override { return "gray area, pixel sizes"; }

  void prepare(const BenchScene& scene) override {
    collect_obstacle_points(scene, tree_.points_m());
    tree_.build();
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    collect_robot_points(scene, robot_C_m_);
    distances_m.clear();
    const auto range_m = static_cast<float>(scene.range_m);
    for (const std::vector<Point>& link : robot_C_m_) {
      ClosestSoFar closest{range_m * range_m};
      for (const Point& p : link) tree_.find(p.data(), closest);
      distances_m.push_back(closest.found ? std::optional(std::sqrt(closest.squared_m2))
                                          : std::nullopt);
    }
  }

 private:
  PointTree<Point> tree_;
  std::vector<std::vector<Point>> robot_C_m_;
};

}  // namespace

std::unique_ptr<Peer> make_nanoflann() { return std::make_unique<NanoflannPeer>(); }

}  // namespace berth::lab
