#include <fcl/geometry/octree/octree.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>
#include <octomap/octomap.h>

#include "berth/pipeline/mounted_camera.hpp"
#include "lab/planning/planning_peer.hpp"
#include "sim/fcl_mesh.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::lab {
namespace {

constexpr float kBehindRobot_m = 0.3f;

class OctomapPeer : public PlanningPeer {
 public:
  OctomapPeer(const RobotModel& model, double resolution_m, bool is_unknown_occupied)
      : model_(model),
        link_trees_(sim::build_link_trees(model)),
        resolution_m_(resolution_m),
        is_unknown_occupied_(is_unknown_occupied) {}

  std::string name() const override {
    return fmt::format("FCL, OctoMap {:.0f} cm, unknown cells {}", 100 * resolution_m_,
                       is_unknown_occupied_ ? "occupied" : "free");
  }

  /// One ray for each cell that the readings end in, not for each reading: the faster way.
  void build(const FrameList& frames, const Eigen::AlignedBox3d& box_B_m) override {
    auto tree = std::make_shared<octomap::OcTree>(resolution_m_);
    for (const auto& frame : frames) insert(*frame, *tree);
    if (is_unknown_occupied_) fill_unknown(box_B_m, *tree);
    tree->updateInnerOccupancy();
    tree->prune();
    octree_ = std::make_unique<fcl::OcTreed>(tree);
  }

  void ask(std::span<const double> positions, double margin_m,
           std::span<Verdict> verdicts) override {
    const std::vector<JointState> all = states_of(positions, model_.joints.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      forward_kinematics(model_, all[i].position, pose_);
      verdicts[i] = is_near(margin_m) ? Verdict::near : Verdict::free;
    }
  }

 private:
  void insert(const Frame& frame, octomap::OcTree& tree) const {
    const Eigen::Vector3d at_m = frame.X_BC.translation();
    const octomap::point3d at(static_cast<float>(at_m.x()), static_cast<float>(at_m.y()),
                              static_cast<float>(at_m.z()));
    octomap::Pointcloud cloud;
    const auto take = [&](const Eigen::Vector3d& p_B_m) {
      const Eigen::Vector3f p = p_B_m.cast<float>();
      cloud.push_back(p.x(), p.y(), p.z());
    };
    for_each_point(frame, frame.obstacles.depth_m, take);
    octomap::KeySet free, occupied;
    tree.computeDiscreteUpdate(cloud, at, free, occupied, -1);
    // Rays that end on the robot fill nothing, and clear as far behind it as in berth: else no
    // place that it moves to would be known.
    DepthImage behind_m = frame.robot.depth_m;
    for (float& z_m : behind_m.pixels()) z_m += kBehindRobot_m;
    cloud.clear();
    for_each_point(frame, behind_m, take);
    octomap::KeySet before_robot, of_robot;
    tree.computeDiscreteUpdate(cloud, at, before_robot, of_robot, -1);
    for (const octomap::OcTreeKey& key : before_robot) free.insert(key);
    for (const octomap::OcTreeKey& key : free) {
      if (occupied.count(key) == 0) tree.updateNode(key, false, true);
    }
    for (const octomap::OcTreeKey& key : occupied) tree.updateNode(key, true, true);
  }

  void fill_unknown(const Eigen::AlignedBox3d& box_B_m, octomap::OcTree& tree) const {
    const auto key_of = [&](const Eigen::Vector3d& p) {
      return tree.coordToKey(p.x(), p.y(), p.z());
    };
    const octomap::OcTreeKey low = key_of(box_B_m.min()), high = key_of(box_B_m.max());
    for (unsigned x = low[0]; x <= high[0]; ++x) {
      for (unsigned y = low[1]; y <= high[1]; ++y) {
        for (unsigned z = low[2]; z <= high[2]; ++z) {
          const octomap::OcTreeKey key(static_cast<octomap::key_type>(x),
                                       static_cast<octomap::key_type>(y),
                                       static_cast<octomap::key_type>(z));
          if (!tree.search(key)) tree.setNodeValue(key, tree.getClampingThresMaxLog(), true);
        }
      }
    }
  }

  bool is_near(double margin_m) const {
    for (const std::size_t link : model_.evaluated_links) {
      if (!model_.is_moved(link) || !link_trees_[link]) continue;
      fcl::DistanceResultd result;
      result.min_distance = margin_m;
      fcl::distance(link_trees_[link].get(), pose_.X_BL[link], octree_.get(),
                    fcl::Transform3d::Identity(), fcl::DistanceRequestd(), result);
      if (result.min_distance < margin_m) return true;
    }
    return false;
  }

  const RobotModel& model_;
  std::vector<sim::MeshTree> link_trees_;
  double resolution_m_;
  bool is_unknown_occupied_;
  RobotPose pose_;
  std::unique_ptr<fcl::OcTreed> octree_;
};

}  // namespace

std::unique_ptr<PlanningPeer> make_octomap_peer(const RobotModel& model, double resolution_m,
                                                bool is_unknown_occupied) {
  return std::make_unique<OctomapPeer>(model, resolution_m, is_unknown_occupied);
}

}  // namespace berth::lab
