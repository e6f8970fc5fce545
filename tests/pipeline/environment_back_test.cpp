// What a table hides below its top is not free.
#include "berth/pipeline/robot_drawing.hpp"

#include <gtest/gtest.h>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/self_filter/surface_things.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth {
namespace {

constexpr float kTop_m = 0.03F;
/// Looks down on the table from 1.5 m.
const Camera kCamera{64, 48, 60, 60, 31.5, 23.5};

/// A link on a table whose top has z = 0, with or without legs and a floor.
RobotModel table_model(bool stands_on_floor) {
  RobotModel model;
  Link table;
  table.name = "table";
  table.role = LinkRole::environment;
  table.id = kEnvironmentLink;
  const auto add = [&](const Eigen::Vector3d& size_m, const Eigen::Vector3d& centre_m) {
    TriangleMesh box = make_box(size_m);
    const auto first = static_cast<std::uint32_t>(table.mesh_L.vertices_m.size());
    for (const auto& p : box.vertices_m) {
      table.mesh_L.vertices_m.emplace_back(p + centre_m.cast<float>());
    }
    for (auto triangle : box.triangles) {
      for (auto& corner : triangle) corner += first;
      table.mesh_L.triangles.push_back(triangle);
    }
  };
  add({1, 1, kTop_m}, {0, 0, -kTop_m / 2});
  if (stands_on_floor) {
    add({0.05, 0.05, 0.7}, {0.4, 0.4, -kTop_m - 0.35});
    add({4, 4, 0.1}, {0, 0, -0.8});
  }
  model.links.push_back(table);
  Link arm;
  arm.name = "arm";
  arm.role = LinkRole::evaluated;
  arm.id = 1;
  arm.parent = 0;
  arm.joint.X_PJ = Pose(Eigen::Translation3d(0, 0, 0.1));
  arm.mesh_L = make_box({0.1, 0.1, 0.2});
  model.links.push_back(arm);
  model.evaluated_links = {1};
  return model;
}

Pose looking_down(double x_m = 0, double height_m = 1.5) {
  Pose X_BC = Pose::Identity();
  X_BC.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  X_BC.translation() = Eigen::Vector3d(x_m, 0, height_m);
  return X_BC;
}

RobotPose pose_of(const RobotModel& model) {
  RobotPose pose;
  forward_kinematics(model, {}, pose);
  return pose;
}

TEST(EnvironmentBack, IsTheNextSurfaceBehindTheOneThatIsSeen) {
  for (const bool stands_on_floor : {false, true}) {
    const RobotModel model = table_model(stands_on_floor);
    EnvironmentBack environment(model, kCamera);
    const auto [front_m, back_m, number] = environment.at(pose_of(model), looking_down());
    // The robot is not there.
    EXPECT_NEAR(front_m(31, 23), 1.5, 1e-4);
    EXPECT_NEAR(back_m(31, 23), 1.53, 1e-4);
    // The same surfaces have the same number.
    EXPECT_EQ(environment.at(pose_of(model), looking_down()).serial_number, number);
    EXPECT_NE(environment.at(pose_of(model), looking_down(0.1)).serial_number, number);
    EXPECT_NEAR(back_m(15, 12), 1.53, 1e-4);
    // Behind the top over a leg is the leg.
    EXPECT_NEAR(back_m(47, 8), 1.53, 1e-4);
    // Beside the table.
    if (stands_on_floor) {
      EXPECT_NEAR(back_m(1, 23), 2.35, 1e-4);
    } else {
      EXPECT_TRUE(std::isnan(back_m(1, 23)));
    }
  }
}

TEST(EnvironmentBack, OfASheetIsTheSheet) {
  RobotModel model = table_model(false);
  TriangleMesh& sheet = model.links[0].mesh_L;
  sheet.vertices_m = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}};
  EnvironmentBack environment(model, kCamera);
  EXPECT_NEAR(environment.at(pose_of(model), looking_down()).back_m(31, 23), 1.5, 1e-4);
}

TEST(EnvironmentBack, GoesWithACameraThatMoves) {
  const RobotModel model = table_model(false);
  EnvironmentBack environment(model, kCamera);
  for (const auto& [x_m, height_m] : {std::pair{0.0, 1.5}, {0.0, 1.5}, {0.3, 1.2}, {0.0, 1.5}}) {
    const DepthView moved_m = environment.at(pose_of(model), looking_down(x_m, height_m)).back_m;
    EnvironmentBack alone(model, kCamera);
    const DepthView alone_m = alone.at(pose_of(model), looking_down(x_m, height_m)).back_m;
    for (int v = 0; v < kCamera.height_px; ++v) {
      for (int u = 0; u < kCamera.width_px; ++u) {
        const float a = moved_m(u, v), b = alone_m(u, v);
        ASSERT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << u << " " << v;
      }
    }
  }
}

TEST(EnvironmentBack, IsNowhereWithoutEnvironment) {
  RobotModel model = table_model(false);
  model.links[0].role = LinkRole::ignored;
  model.links[0].id = kNoLink;
  EnvironmentBack environment(model, kCamera);
  EXPECT_EQ(environment.at(pose_of(model), looking_down()).back_m.width, 0);
}

/// A camera sees the bare table from above; what it frees below a point of the table's top.
class UnderTheTable : public ::testing::Test {
 protected:
  double freed_below_m(const RobotModel& model) {
    const auto robot = std::make_shared<const Robot>(model);
    const auto mounted = std::make_shared<const MountedCamera>(
        robot, CameraMount{kCamera, "table", looking_down(), "above"});
    DepthImage depth_m(kCamera.width_px, kCamera.height_px, 1.5F);
    Frame frame;
    Observer(mounted).observe(depth_m, JointState{}, frame);
    EXPECT_EQ(frame.obstacles.fate(18, 23), PixelFate::environment);
    // As far as it sees, less the table's distance.
    return in_metres(frame.space->seen.free_depth(18, 23)) - 1.5;
  }
};

TEST_F(UnderTheTable, SpaceIsFreeUpToTheTopsLowerSide) {
  EXPECT_NEAR(freed_below_m(table_model(false)), kTop_m, 1e-3);
  EXPECT_NEAR(freed_below_m(table_model(true)), kTop_m, 1e-3);
}

TEST_F(UnderTheTable, SpaceIsFreeNoFartherThanBehindTheRobot) {
  RobotModel model = table_model(false);
  for (auto& p : model.links[0].mesh_L.vertices_m) {
    if (p.z() < -0.01F) p.z() = -0.7F;
  }
  EXPECT_NEAR(freed_below_m(model), 0.3, 1e-3);
}

/// What lies on the link, or on the table below it, and is taken for that surface. The arm is
/// between 0.5 and 0.7 m above the table.
class AssumedThinner : public ::testing::Test {
 protected:
  /// Of cameras that look down from above; the first one sees the arm before the table.
  float of_arm_m(double range_m, const std::vector<Pose>& cameras) {
    RobotModel model = table_model(false);
    model.links[1].joint.X_PJ = Pose(Eigen::Translation3d(0, 0, 0.6));
    EvaluationSettings settings;
    settings.distance.range_m = range_m;
    const auto robot = std::make_shared<const Robot>(model, settings);
    CameraSettings of_camera;
    of_camera.self_filter.surface_tolerance_m = 0.012;
    std::vector<Frame> frames(cameras.size());
    std::vector<const Frame*> asked;
    for (std::size_t k = 0; k < cameras.size(); ++k) {
      const CameraMount mount{kCamera, "table", cameras[k], "camera" + std::to_string(k)};
      Observer observer(std::make_shared<const MountedCamera>(robot, mount, of_camera));
      const auto depth_m = static_cast<float>(cameras[k].translation().z());
      observer.observe(DepthImage(kCamera.width_px, kCamera.height_px, depth_m), JointState{},
                       frames[k]);
      asked.push_back(&frames[k]);
    }
    return Query(robot).ask({asked}).links[0].assumed_thinner_m;
  }
  static double told_from_m(double z_m) { return 1.05 * 0.012 * surface_growth(z_m); }
};

TEST_F(AssumedThinner, IsThatOfTheEnvironmentWhereItIsFarther) {
  EXPECT_NEAR(of_arm_m(1, {looking_down()}), told_from_m(1.5), 1e-5);
  // The table is not within range.
  EXPECT_NEAR(of_arm_m(0.3, {looking_down()}), told_from_m(0.9), 1e-5);
}

TEST_F(AssumedThinner, IsThatOfACameraThatTheRobotDoesNotStandBefore) {
  EXPECT_NEAR(of_arm_m(1, {looking_down(), looking_down(0.6, 2)}), told_from_m(2), 1e-5);
  // Before the arm the nearer one counts.
  EXPECT_NEAR(of_arm_m(0.3, {looking_down(), looking_down(0.6, 2)}), told_from_m(0.9), 1e-5);
}

}  // namespace
}  // namespace berth
