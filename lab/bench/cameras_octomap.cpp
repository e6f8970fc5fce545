#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>
#include <octomap/octomap.h>

#include <algorithm>

#include "lab/bench/cameras_peer.hpp"
#include "lab/bench/cameras_points.hpp"
#include "sim/fcl_mesh.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::lab {
namespace {

class CamerasOctomap : public CamerasPeer {
 public:
  CamerasOctomap(const RobotModel& model, double resolution_m)
      : links_(model.evaluated_links),
        link_trees_(sim::build_link_trees(model)),
        resolution_m_(resolution_m) {}

  std::string name() const override {
    return fmt::format("FCL, OctoMap {:.0f} cm", 100 * resolution_m_);
  }
  std::string lacks() const override { return "unknown space; rounds to cells"; }

  /// One ray for each cell that the readings end in, not for each reading: the faster way.
  void build(const WholeRobotScene& scene) override {
    auto tree = std::make_shared<octomap::OcTree>(resolution_m_);
    for (const CameraImages& view : scene.views) {
      cloud_.clear();
      for_each_reading(scene.camera, view, [&](const Eigen::Vector3f& p_B_m) {
        cloud_.push_back(p_B_m.x(), p_B_m.y(), p_B_m.z());
      });
      const Eigen::Vector3f at_m = view.X_BC.translation().cast<float>();
      tree->insertPointCloud(cloud_, {at_m.x(), at_m.y(), at_m.z()}, -1, true, true);
    }
    tree->updateInnerOccupancy();
    octree_ = std::make_unique<fcl::OcTreed>(tree);
  }

  std::vector<std::optional<double>> ask(const WholeRobotScene& scene, double range_m) override {
    std::vector<std::optional<double>> distances_m;
    for (const std::size_t link : links_) {
      fcl::DistanceResultd result;
      result.min_distance = range_m;
      fcl::distance(link_trees_[link].get(), scene.pose.X_BL[link], octree_.get(),
                    fcl::Transform3d::Identity(), fcl::DistanceRequestd(), result);
      distances_m.push_back(result.min_distance < range_m
                                ? std::optional(std::max(0.0, result.min_distance))
                                : std::nullopt);
    }
    return distances_m;
  }

 private:
  std::vector<std::size_t> links_;
  std::vector<sim::MeshTree> link_trees_;
  double resolution_m_;
  octomap::Pointcloud cloud_;
  std::unique_ptr<fcl::OcTreed> octree_;
};

}  // namespace

std::unique_ptr<CamerasPeer> make_cameras_octomap(const RobotModel& model, double resolution_m) {
  return std::make_unique<CamerasOctomap>(model, resolution_m);
}

}  // namespace berth::lab
