#include "berth/distance/link_balls.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "lab/measure/point_tree.hpp"
#include "lab/planning/planning_peer.hpp"

namespace berth::lab {
namespace {

/// Ends the search with the first point that is near enough.
struct AnyWithin {
  float squared_m2;
  bool found = false;

  std::size_t size() const { return found; }
  bool full() const { return true; }
  float worstDist() const { return squared_m2; }
  bool addPoint(float point_squared_m2, std::size_t) {
    found = found || point_squared_m2 <= squared_m2;
    return !found;
  }
};

class PointsPeer : public PlanningPeer {
 public:
  explicit PointsPeer(const RobotModel& model) : model_(model) {
    for (const std::size_t link : model.evaluated_links) {
      if (!model.is_moved(link)) continue;
      links_.push_back(link);
      balls_.push_back(mesh::build_link_balls(model.links[link].mesh_L));
    }
  }

  std::string name() const override { return "nanoflann k-d tree, our balls (as CAPT)"; }

  void build(const FrameList& frames, const Eigen::AlignedBox3d&) override {
    tree_.points_m().clear();
    for (const auto& frame : frames) {
      for_each_point(*frame, frame->obstacles.depth_m, [&](const Eigen::Vector3d& p_B_m) {
        tree_.points_m().push_back(p_B_m.cast<float>());
      });
    }
    tree_.build();
  }

  void ask(std::span<const double> positions, double margin_m,
           std::span<Verdict> verdicts) override {
    const std::vector<JointState> all = states_of(positions, model_.joints.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      forward_kinematics(model_, all[i].position, pose_);
      verdicts[i] = is_near(static_cast<float>(margin_m)) ? Verdict::near : Verdict::free;
    }
  }

 private:
  bool is_near(float margin_m) const {
    for (std::size_t l = 0; l < links_.size(); ++l) {
      const Eigen::Isometry3f X_BL(pose_.X_BL[links_[l]].cast<float>());
      for (std::size_t k = 0; k < 8; ++k) {
        if (!any_within(X_BL, balls_[l].coarse, k, margin_m)) continue;
        for (std::size_t f = 0; f < 8; ++f) {
          if (any_within(X_BL, balls_[l].fine[k], f, margin_m)) return true;
        }
      }
    }
    return false;
  }

  bool any_within(const Eigen::Isometry3f& X_BL, const mesh::EightBalls& balls, std::size_t i,
                  float margin_m) const {
    if (balls.radius_m[i] < 0) return false;
    const Eigen::Vector3f at_B_m = X_BL * Eigen::Vector3f(balls.x_m[i], balls.y_m[i], balls.z_m[i]);
    const float within_m = balls.radius_m[i] + margin_m;
    AnyWithin any{within_m * within_m};
    tree_.find(at_B_m.data(), any);
    return any.found;
  }

  const RobotModel& model_;
  std::vector<std::size_t> links_;
  std::vector<mesh::LinkBalls> balls_;
  RobotPose pose_;
  PointTree<Eigen::Vector3f> tree_;
};

}  // namespace

std::unique_ptr<PlanningPeer> make_points_peer(const RobotModel& model) {
  return std::make_unique<PointsPeer>(model);
}

}  // namespace berth::lab
