// The map of detection, on images of which it can be reckoned.
#include "berth/calibration/detection_map.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "tests/fit/hand_made_image.hpp"

namespace berth {
namespace {

constexpr Camera kSmall{160, 120, 125, 125, 79.5, 59.5};

DetectionImage image_of(const HandMadeImage& drawn, DepthImage depth_m) {
  return {std::move(depth_m), drawn.robot, Pose::Identity()};
}

/// At B's origin, looking along z at a wall 4 m away, without a robot.
DetectionCamera looking_at_wall(const Camera& camera = kSmall, float wall_m = 4) {
  HandMadeImage image;
  image.camera = camera;
  image.robot = {DepthImage(camera.width_px, camera.height_px, kNoDepth),
                 Image<LinkId>(camera.width_px, camera.height_px, kNoLink)};
  return {camera, {}, {}, {image_of(image, sensed(image.robot, wall_m))}};
}

/// All of both in the image.
const RobotReach kReach{{0, 0, 1.5}, 0.1}, kWideReach{{0, 0, 1.5}, 0.4};

DetectionMap measure(const std::vector<DetectionCamera>& cameras,
                     const RobotReach& reach = kReach) {
  return measure_detection(cameras, reach, [] {});
}

TEST(DetectionMap, HasPlacesWithinReachAlone) {
  const DetectionMap map = measure({looking_at_wall()}, kWideReach);
  EXPECT_GE(map.places_B_m.size(), 400U);
  EXPECT_LE(map.places_B_m.size(), 650U);
  for (const Eigen::Vector3d& place_B_m : map.places_B_m) {
    EXPECT_LE((place_B_m - kWideReach.center_B_m).norm(), kWideReach.radius_m);
  }
  EXPECT_EQ(map.cell.least_m.size(), map.places_B_m.size());
  EXPECT_EQ(map.cell.in_view(), static_cast<int>(map.places_B_m.size()));
}

TEST(DetectionMap, ABallNeedsAsManyPixelsAsTheRulesAskFor) {
  DetectionCamera camera = looking_at_wall();
  camera.sensor.phantom_radius_m = 0;
  camera.sensor.speckle_px = 0;
  // A ball of 20 mm 1.5 m away has 1.7 pixels across: one of them is always hit.
  EXPECT_LE(measure({camera}).cell.median_m(), 0.02);
  camera.sensor.speckle_px = 16;
  // 4.5 pixels across are needed, 54 mm.
  EXPECT_EQ(measure({camera}).cell.median_m(), 0.06);
  camera.sensor.speckle_px = 200;
  const DetectedDiameters none = measure({camera}).cell;
  EXPECT_TRUE(std::isinf(none.median_m()));
  EXPECT_TRUE(std::isinf(none.worst_m()));
  EXPECT_EQ(none.told(0.08), 0);
  EXPECT_GT(none.in_view(), 0);
}

TEST(DetectionMap, FartherAwayBallsHaveToBeLarger) {
  DetectionCamera camera = looking_at_wall();
  camera.sensor.speckle_px = 8;
  const DetectionMap map = measure({camera}, kWideReach);
  EXPECT_EQ(map.cell.least_m[map.cell.worst_place()], map.cell.worst_m());
  double near_m = 0, far_m = HUGE_VAL;
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    const double z_m = map.places_B_m[i].z(), least_m = map.cell.least_m[i];
    if (z_m < 1.2) near_m = std::max(near_m, least_m);
    if (z_m > 1.8) far_m = std::min(far_m, least_m);
  }
  EXPECT_LT(near_m, far_m);
}

TEST(DetectionMap, BehindAWallAndBesideTheImageNothingIsInView) {
  const DetectedDiameters hidden = measure({looking_at_wall(kSmall, 1)}).cell;
  EXPECT_EQ(hidden.in_view(), 0);
  EXPECT_TRUE(std::isnan(hidden.median_m()));
  EXPECT_TRUE(std::isnan(hidden.worst_m()));
  const RobotReach behind{{0, 0, -1}, 0.4};
  EXPECT_EQ(measure({looking_at_wall()}, behind).cell.in_view(), 0);
}

TEST(DetectionMap, OneCameraIsEnoughToTell) {
  DetectionCamera blurred = looking_at_wall();
  blurred.sensor.speckle_px = 200;
  const DetectionMap map = measure({blurred, looking_at_wall(), {kSmall, {}, {}, {}}});
  ASSERT_EQ(map.cameras.size(), 3U);
  EXPECT_TRUE(std::isinf(map.cameras[0].median_m()));
  EXPECT_LE(map.cameras[1].worst_m(), 0.04);
  EXPECT_EQ(map.cameras[2].in_view(), 0) << "it has no images";
  EXPECT_LE(map.cell.worst_m(), map.cameras[1].worst_m());
}

TEST(DetectionMap, NothingIsSaidOfBallsAtTheRobot) {
  HandMadeImage image;
  image.camera = kSmall;
  image.robot = {DepthImage(160, 120, kNoDepth), Image<LinkId>(160, 120, kNoLink)};
  add_plate({0, 0, 160, 120}, 1.5F, 1, image);
  const DetectionCamera camera{kSmall, {}, {}, {image_of(image, sensed(image.robot))}};
  const DetectionMap map = measure({camera}, kWideReach);
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    const double before_m = 1.5 - map.places_B_m[i].z();
    if (before_m < 0.05) {
      EXPECT_TRUE(std::isnan(map.cell.least_m[i])) << before_m;
    } else if (before_m > 0.20) {
      EXPECT_LE(map.cell.least_m[i], 0.04) << before_m;
    }
  }
}

TEST(DetectionMap, NothingIsDetectedWhereSomethingSoftMayHang) {
  const Eigen::Vector3d middle_m(0, 0, 1.5);
  const SoftBody body(0, make_sphere(0.25));
  DetectionCamera camera = looking_at_wall();
  const DetectionMap without = measure({camera}, kWideReach);
  camera.images[0].soft = {{&body, Pose(Eigen::Translation3d(-middle_m))}};
  const DetectionMap map = measure({camera}, kWideReach);
  int inside = 0;
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    const double off_m = (map.places_B_m[i] - middle_m).norm();
    if (off_m < 0.12) {
      ++inside;
      EXPECT_TRUE(std::isinf(map.cell.least_m[i])) << off_m;
    }
    if (off_m > 0.38) {
      EXPECT_LE(map.cell.least_m[i], without.cell.least_m[i] + 0.02) << off_m;
    }
  }
  EXPECT_GT(inside, 5);
}

TEST(DetectionMap, DropoutsCost) {
  DetectionCamera camera = looking_at_wall();
  camera.sensor.speckle_px = 0;
  camera.sensor.phantom_radius_m = 0;
  const double whole_m = measure({camera}).cell.median_m();
  DepthImage& depth_m = camera.images[0].depth_m;
  // Of each 2 x 2 pixels one is lost.
  for (int v = 0; v < 120; v += 2) {
    for (int u = 0; u < 160; u += 2) depth_m(u, v) = kNoDepth;
  }
  EXPECT_GT(measure({camera}).cell.median_m(), whole_m);
}

TEST(DetectionMap, IsTheSameOnOneThread) {
  const std::vector<DetectionCamera> cameras{looking_at_wall()};
  const DetectionMap many = measure(cameras);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(measure(cameras).cell.least_m, many.cell.least_m);
}

TEST(DetectionMap, WithoutAReachOrCamerasItIsEmpty) {
  EXPECT_TRUE(measure({}).empty());
  EXPECT_TRUE(measure({looking_at_wall()}, {}).empty());
}

TEST(DetectionMap, APauseThatThrowsStopsIt) {
  const auto stop = [] { throw std::runtime_error("stopped"); };
  EXPECT_THROW(measure_detection({looking_at_wall()}, kReach, stop), std::runtime_error);
}

/// A post of 2 m that turns on a plinth, with an arm of 0.5 m on top.
RobotModel turning_post(JointType type, double limit) {
  RobotModel model;
  model.links.resize(2);
  Link& post = model.links[1];
  post.parent = 0;
  post.id = 1;
  post.joint.type = type;
  post.joint.X_PJ.translation() << 0, 0, 0.3;
  post.joint.axis_J = Eigen::Vector3d::UnitZ();
  post.joint.position_index = 0;
  post.mesh_L.vertices_m = {{0, 0, 0}, {0.5F, 0, 2}, {0, 0.01F, 2}};
  post.mesh_L.triangles = {{0, 1, 2}};
  model.links[0].mesh_L.vertices_m = {{9, 9, 9}, {9, 8, 9}, {8, 9, 9}};
  model.links[0].mesh_L.triangles = {{0, 1, 2}};
  model.joints = {{"turn", type, -limit, limit}};
  model.evaluated_links = {1};
  return model;
}

TEST(RobotReach, HoldsWhatJointsMove) {
  for (const double limit : {0.5, HUGE_VAL}) {
    const RobotReach reach = robot_reach(turning_post(JointType::continuous, limit));
    EXPECT_TRUE(reach.center_B_m.isApprox(Eigen::Vector3d(0, 0, 0.3)));
    EXPECT_NEAR(reach.radius_m, std::sqrt(4.25), 1e-3) << "not the plinth, which stands";
  }
  const RobotReach lifted = robot_reach(turning_post(JointType::prismatic, 1));
  EXPECT_NEAR(lifted.radius_m, std::hypot(0.5, 3), 0.01);
  EXPECT_NEAR(robot_reach(turning_post(JointType::prismatic, HUGE_VAL)).radius_m, std::sqrt(4.25),
              1e-3);
}

TEST(RobotReach, IsNoneWhereNothingMoves) {
  EXPECT_EQ(robot_reach(turning_post(JointType::fixed, 1)).radius_m, 0);
}

}  // namespace
}  // namespace berth
