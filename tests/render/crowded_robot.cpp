#include "tests/render/crowded_robot.hpp"

#include <cmath>

namespace berth {
namespace {

TriangleMesh crowd(std::mt19937& random, int triangles) {
  std::normal_distribution<float> normal;
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Eigen::Vector3f centre(normal(random), normal(random), normal(random));
    // Most of them small, like the triangles of a fine mesh.
    const float size_m = 0.002F * std::exp(std::abs(normal(random)) * 2);
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (int corner = 0; corner < 3; ++corner) {
      mesh.vertices_m.push_back(
          centre + size_m * Eigen::Vector3f(normal(random), normal(random), normal(random)));
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace

CrowdedRobot::CrowdedRobot(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<TriangleMesh> meshes;
  std::vector<Pose> X_CL;
  for (int link = 0; link < 5; ++link) {
    meshes.push_back(crowd(random, 4003));
    X_CL.push_back(random_pose(random, {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 3)}));
  }
  // The same triangles twice: where they are seen, the smaller id wins.
  meshes.push_back(meshes.back());
  X_CL.push_back(X_CL.back());
  model = robot_of(std::move(meshes));
  pose = pose_seen_at(Pose::Identity(), X_CL);
}

}  // namespace berth
