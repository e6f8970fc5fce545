// FLANN, whose KD-tree PCL uses: built for each frame and asked for every robot pixel.
#include <cmath>
#include <flann/flann.hpp>

#include "lab/bench/closest_so_far.hpp"
#include "lab/bench/peer.hpp"
#include "lab/bench/points.hpp"

namespace berth::lab {
namespace {

/// The fastest of those tried: 15 (PCL's), 64, 128.
constexpr int kFlannLeafPoints = 64;

class FlannResult : public flann::ResultSet<float> {
 public:
  explicit FlannResult(float squared_m2) : closest{squared_m2} {}
  bool full() const override { return closest.full(); }
  float worstDist() const override { return closest.worstDist(); }
  void addPoint(float squared_m2, std::size_t index) override {
    closest.addPoint(squared_m2, index);
  }

  ClosestSoFar closest;
};

class FlannPeer : public Peer {
 public:
  std::string name() const override { return "FLANN KD-tree"; }
  std::string lacks() const override { return "gray area, pixel sizes"; }

  void prepare(const BenchScene& scene) override {
    collect_obstacle_points(scene, points_C_m_);
    tree_.reset();
    if (points_C_m_.empty()) return;
    const flann::Matrix<float> points(points_C_m_[0].data(), points_C_m_.size(), 3);
    tree_.emplace(points, flann::KDTreeSingleIndexParams(kFlannLeafPoints));
    tree_->buildIndex();
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    collect_robot_points(scene, robot_C_m_);
    distances_m.assign(robot_C_m_.size(), std::nullopt);
    if (!tree_) return;
    const auto range_m = static_cast<float>(scene.range_m);
    for (std::size_t i = 0; i < robot_C_m_.size(); ++i) {
      FlannResult result(range_m * range_m);
      for (const Point& p : robot_C_m_[i]) tree_->findNeighbors(result, p.data(), search_);
      if (result.closest.found) distances_m[i] = std::sqrt(result.closest.squared_m2);
    }
  }

 private:
  std::vector<Point> points_C_m_;
  std::optional<flann::KDTreeSingleIndex<flann::L2_Simple<float>>> tree_;
  flann::SearchParams search_{flann::FLANN_CHECKS_UNLIMITED};
  std::vector<std::vector<Point>> robot_C_m_;
};

}  // namespace

std::unique_ptr<Peer> make_flann() { return std::make_unique<FlannPeer>(); }

}  // namespace berth::lab
