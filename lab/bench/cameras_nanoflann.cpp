#include "lab/bench/cameras_peer.hpp"
#include "lab/bench/cameras_points.hpp"
#include "lab/bench/closest_so_far.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/measure/point_tree.hpp"

namespace berth::lab {
namespace {

constexpr float kSampleStep_m = 0.005f;

float longest_edge_m(const TriangleMesh& mesh) {
  float longest_m = 0;
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3f edge_m =
          mesh.vertices_m[triangle[(k + 1) % 3]] - mesh.vertices_m[triangle[k]];
      longest_m = std::max(longest_m, edge_m.norm());
    }
  }
  return longest_m;
}

/// The corners of the mesh cut until no edge is longer than the step, each once.
std::vector<Eigen::Vector3f> sample(const TriangleMesh& mesh_L) {
  const int parts = static_cast<int>(std::ceil(longest_edge_m(mesh_L) / kSampleStep_m));
  std::vector<Eigen::Vector3f> points_L_m = subdivide(mesh_L, std::max(1, parts)).vertices_m;
  const auto before = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points_L_m.begin(), points_L_m.end(), before);
  points_L_m.erase(std::unique(points_L_m.begin(), points_L_m.end()), points_L_m.end());
  return points_L_m;
}

class CamerasNanoflann : public CamerasPeer {
 public:
  explicit CamerasNanoflann(const RobotModel& model) : links_(model.evaluated_links) {
    for (const std::size_t link : links_) samples_L_m_.push_back(sample(model.links[link].mesh_L));
  }

  std::string name() const override { return "nanoflann KD-tree, samples 5 mm"; }
  std::string lacks() const override {
    return "unknown space, pixel sizes, what lies between samples";
  }

  void build(const WholeRobotScene& scene) override {
    tree_.points_m().clear();
    for (const CameraImages& view : scene.views) {
      for_each_reading(scene.camera, view,
                       [&](const Eigen::Vector3f& p_B_m) { tree_.points_m().push_back(p_B_m); });
    }
    tree_.build();
  }

  std::vector<std::optional<double>> ask(const WholeRobotScene& scene, double range_m) override {
    std::vector<std::optional<double>> distances_m;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Eigen::Isometry3f X_BL(scene.pose.X_BL[links_[i]].cast<float>());
      ClosestSoFar closest{static_cast<float>(range_m * range_m)};
      for (const Eigen::Vector3f& p_L_m : samples_L_m_[i]) {
        const Eigen::Vector3f p_B_m = X_BL * p_L_m;
        tree_.find(p_B_m.data(), closest);
      }
      distances_m.push_back(closest.found ? std::optional<double>(std::sqrt(closest.squared_m2))
                                          : std::nullopt);
    }
    return distances_m;
  }

 private:
  std::vector<std::size_t> links_;
  std::vector<std::vector<Eigen::Vector3f>> samples_L_m_;
  PointTree<Eigen::Vector3f> tree_;
};

}  // namespace

std::unique_ptr<CamerasPeer> make_cameras_nanoflann(const RobotModel& model) {
  return std::make_unique<CamerasNanoflann>(model);
}

}  // namespace berth::lab
