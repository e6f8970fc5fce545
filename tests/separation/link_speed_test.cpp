// The speed of a link's fastest point against that of all its vertices.
#include "berth/separation/link_speed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

constexpr float kSlack_m = 0.005F;

RobotModel bundled_arm() {
  RobotSettings settings;
  settings.urdf = BERTH_SOURCE_DIR "/data/bundled/arm/arm.urdf";
  settings.package_paths["berth_arm"] = BERTH_SOURCE_DIR "/data/bundled/arm";
  return load_robot(settings);
}

struct Drawn {
  Pose X_BL = Pose::Identity();
  LinkTwist twist;
  Pose X_BL_before = Pose::Identity();
};

Eigen::Vector3d draw_vector(std::mt19937& random) {
  std::normal_distribution<double> number;
  return {number(random), number(random), number(random)};
}

Drawn draw(std::mt19937& random) {
  Drawn drawn;
  drawn.X_BL.linear() = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
  drawn.X_BL.translation() = draw_vector(random);
  drawn.twist = {draw_vector(random), draw_vector(random)};
  drawn.X_BL_before.linear() = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
  drawn.X_BL_before.translation() = draw_vector(random);
  return drawn;
}

Eigen::Vector3d velocity_of(const Drawn& drawn, const Eigen::Vector3f& p_L) {
  const Eigen::Vector3d arm_B = drawn.X_BL.linear() * p_L.cast<double>();
  return drawn.twist.linear_B_m_s + drawn.twist.angular_B_rad_s.cross(arm_B);
}

TEST(LinkSpeed, IsThatOfTheFastestVertexOrHardlyMore) {
  const RobotModel arm = bundled_arm();
  std::mt19937 random(1);
  std::srand(1);  // Eigen's
  for (const std::size_t index : arm.evaluated_links) {
    const TriangleMesh& mesh = arm.links[index].mesh_L;
    const HullPoints hull = hull_points(mesh, kSlack_m);
    EXPECT_LT(hull.points_L_m.size(), 150U) << arm.links[index].name;
    for (int i = 0; i < 50; ++i) {
      const Drawn drawn = draw(random);
      double fastest = 0, farthest_m = 0;
      for (const Eigen::Vector3f& p_L : mesh.vertices_m) {
        const Eigen::Vector3d v = velocity_of(drawn, p_L);
        fastest = std::max(fastest, v.norm());
        const Eigen::Vector3d p = p_L.cast<double>();
        farthest_m = std::max(farthest_m, (drawn.X_BL * p - drawn.X_BL_before * p).norm());
      }
      const double slack = 2 * kSlack_m * drawn.twist.angular_B_rad_s.norm();
      const double found = greatest_speed_m_s(hull, drawn.X_BL, drawn.twist);
      EXPECT_GE(found, fastest - 1e-5);
      EXPECT_LE(found, fastest + slack + 1e-5);
      const double moved_m = greatest_displacement_m(hull, drawn.X_BL_before, drawn.X_BL);
      const double turned = (drawn.X_BL.linear() - drawn.X_BL_before.linear()).norm();
      EXPECT_GE(moved_m, farthest_m);
      EXPECT_LE(moved_m, farthest_m + 2 * kSlack_m * turned + 1e-5);
    }
  }
}

TEST(LinkSpeed, ATurningBoxIsFastestAtItsCorner) {
  TriangleMesh box;
  for (const float x : {-1.0F, 3.0F}) {
    for (const float y : {-4.0F, 4.0F}) {
      for (const float z : {-1.0F, 1.0F}) box.vertices_m.emplace_back(x, y, z);
    }
  }
  const HullPoints hull = hull_points(box, 1e-4F);
  const LinkTwist turn{Eigen::Vector3d::Zero(), 2 * Eigen::Vector3d::UnitZ()};
  EXPECT_NEAR(greatest_speed_m_s(hull, Pose::Identity(), turn), 10, 1e-3);
}

TEST(LinkSpeed, ALinkWithoutVerticesHasNone) {
  const HullPoints none = hull_points(TriangleMesh());
  EXPECT_TRUE(none.points_L_m.empty());
  const LinkTwist away{-Eigen::Vector3d::UnitX(), Eigen::Vector3d::Zero()};
  EXPECT_EQ(greatest_speed_m_s(none, Pose::Identity(), away), 0);
}

}  // namespace
}  // namespace berth
