// FCL's distance between the links' meshes and an OctoMap octree that is filled for each frame:
// what MoveIt does.
#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>
#include <octomap/octomap.h>

#include <algorithm>

#include "lab/bench/peer.hpp"
#include "lab/bench/points.hpp"
#include "sim/fcl_mesh.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::lab {
namespace {

class FclOctomapPeer : public Peer {
 public:
  explicit FclOctomapPeer(double resolution_m) : resolution_m_(resolution_m) {}

  std::string name() const override {
    return fmt::format("FCL, OctoMap {:.0f} cm", 100 * resolution_m_);
  }
  std::string lacks() const override { return "gray area; rounds to cells; sees hidden sides"; }

  void load(const BenchScene& scene) override {
    if (scene.shapes_L == shapes_L_) return;
    shapes_L_ = scene.shapes_L;
    links_.clear();
    for (const TriangleMesh& mesh_L : *shapes_L_) links_.push_back(sim::build_mesh_tree(mesh_L));
  }

  void prepare(const BenchScene& scene) override {
    collect_obstacle_points(scene, points_C_m_);
    auto tree = std::make_shared<octomap::OcTree>(resolution_m_);
    collect_cells(*tree);
    for (const octomap::OcTreeKey& key : cells_) {
      tree->setNodeValue(key, tree->getClampingThresMaxLog(), true);
    }
    tree->updateInnerOccupancy();
    octree_ = std::make_shared<fcl::OcTreed>(tree);
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    distances_m.assign(links_.size(), std::nullopt);
    const fcl::DistanceRequestd request;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (!links_[i] || cells_.empty()) continue;
      fcl::DistanceResultd result;
      result.min_distance = scene.range_m;
      fcl::distance(links_[i].get(), scene.X_CL[i], octree_.get(), fcl::Transform3d::Identity(),
                    request, result);
      if (result.min_distance < scene.range_m) {
        distances_m[i] = static_cast<float>(std::max(0.0, result.min_distance));
      }
    }
  }

 private:
  /// Each cell once: neighbouring pixels mostly share theirs, so sorting is cheaper than a set.
  void collect_cells(const octomap::OcTree& tree) {
    cells_.clear();
    for (const Point& p : points_C_m_) {
      const octomap::OcTreeKey key = tree.coordToKey(p[0], p[1], p[2]);
      if (cells_.empty() || cells_.back() != key) cells_.push_back(key);
    }
    const auto before = [](const octomap::OcTreeKey& a, const octomap::OcTreeKey& b) {
      return std::lexicographical_compare(a.k, a.k + 3, b.k, b.k + 3);
    };
    std::sort(cells_.begin(), cells_.end(), before);
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
  }

  double resolution_m_;
  std::shared_ptr<const LinkShapes> shapes_L_;
  std::vector<sim::MeshTree> links_;
  std::vector<Point> points_C_m_;
  std::vector<octomap::OcTreeKey> cells_;
  std::shared_ptr<fcl::OcTreed> octree_;
};

}  // namespace

std::unique_ptr<Peer> make_fcl_octomap(double resolution_m) {
  return std::make_unique<FclOctomapPeer>(resolution_m);
}

}  // namespace berth::lab
