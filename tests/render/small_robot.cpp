#include "tests/render/small_robot.hpp"

#include "berth/robot/primitives.hpp"

namespace berth {
namespace {

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Eigen::Vector3d random_point(std::mt19937& random, const Eigen::AlignedBox3d& box) {
  return {between(random, box.min().x(), box.max().x()),
          between(random, box.min().y(), box.max().y()),
          between(random, box.min().z(), box.max().z())};
}

TriangleMesh triangle_cloud(std::mt19937& random, double size_m) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-size_m),
                                Eigen::Vector3d::Constant(size_m));
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices_m.push_back(random_point(random, box).cast<float>());
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

}  // namespace

RobotModel robot_of(std::vector<TriangleMesh> meshes) {
  RobotModel model;
  model.name = "small";
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Link link;
    link.name = "link_" + std::to_string(i + 1);
    if (i > 0) link.parent = 0;
    link.role = LinkRole::evaluated;
    link.id = static_cast<LinkId>(i + 1);
    link.mesh_L = std::move(meshes[i]);
    model.links.push_back(std::move(link));
    model.evaluated_links.push_back(i);
  }
  return model;
}

void set_last_role(RobotModel& model, LinkRole role) {
  Link& link = model.links.back();
  link.role = role;
  link.id = role == LinkRole::environment ? kEnvironmentLink : kNoLink;
  model.evaluated_links.pop_back();
}

RobotPose pose_seen_at(const Pose& X_BC, const std::vector<Pose>& X_CL) {
  RobotPose pose;
  for (const Pose& X : X_CL) pose.X_BL.push_back(X_BC * X);
  return pose;
}

Pose random_pose(std::mt19937& random, const Eigen::AlignedBox3d& positions) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  Pose X = Pose::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  X.translation() = random_point(random, positions);
  return X;
}

TriangleMesh random_mesh(std::mt19937& random) {
  const double size_m = between(random, 0.02, 1);
  switch (random() % 4) {
    case 0:
      return make_box({size_m, between(random, 0.02, 1), between(random, 0.02, 1)});
    case 1:
      return make_cylinder(size_m / 2, between(random, 0.02, 1));
    case 2:
      return make_sphere(size_m / 2);
    default:
      return triangle_cloud(random, size_m / 2);
  }
}

}  // namespace berth
