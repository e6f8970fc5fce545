// The slow twin by itself: against points that it has to keep apart, and against answers on paper.
#include "sim/whole_robot_twin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "berth/robot/primitives.hpp"
#include "flat_view.hpp"
#include "sim/cube_content.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/odd_views.hpp"
#include "sim/turn_between.hpp"
#include "tests/support/known_arms.hpp"
#include "tests/support/thinned.hpp"

namespace berth::sim {
namespace {

constexpr DrawnSceneSettings kSmall{.width_px = 160, .height_px = 120};

class WholeRobotTwin : public ::testing::Test {
 protected:
  const RobotModel model_ = load_robot(bundled_arm());
  const std::vector<MeshTree> trees_ = build_link_trees(model_);
};

Eigen::Vector3d draw_point(Random& random, const CentredCube& cube) {
  Eigen::Vector3d p_B = cube.centre_B;
  for (double& x : p_B) x += cube.half_m * random(-1, 1);
  return p_B;
}

Eigen::Vector3d draw_point(Random& random, const TriangleMesh& mesh, const Pose& X_BM) {
  const auto& corners =
      mesh.triangles[random.whole(0, static_cast<int>(mesh.triangles.size()) - 1)];
  const double a = std::sqrt(random(0, 1));
  const double b = random(0, 1);
  const auto corner = [&](int i) { return mesh.vertices_m[corners[i]].cast<double>(); };
  return X_BM * ((1 - a) * corner(0) + a * (1 - b) * corner(1) + a * b * corner(2));
}

TEST_F(WholeRobotTwin, ACubeThatIsNoneOrAllHoldsNoOtherPoint) {
  int none = 0, all = 0;
  for (std::uint32_t seed = 0; seed < thinned(8U); ++seed) {
    const DrawnViews drawn =
        draw_views(model_, trees_, kSmall, seed, 1 + static_cast<int>(seed % 4));
    const PointSpace space = point_space(drawn.views, {});
    const CubeContent content(space);
    Random random(seed);
    for (int i = 0; i < 4000; ++i) {
      const CentredCube room{{0, 0, 0}, 1.5};
      const CentredCube cube{draw_point(random, room), 0.3 * std::pow(10, random(-4, 0))};
      for (const Wanted wanted : {Wanted::reading, Wanted::obstacle}) {
        const Content is = content(cube, wanted);
        if (is == Content::some) continue;
        ++(is == Content::none ? none : all);
        for (int j = 0; j < 10; ++j) {
          const Eigen::Vector3d p_B = draw_point(random, cube);
          const bool counts =
              wanted == Wanted::reading ? space.is_reading(p_B) : space.is_obstacle(p_B);
          ASSERT_EQ(counts, is == Content::all) << "seed " << seed << ", cube " << i;
        }
      }
    }
  }
  EXPECT_GT(none, 1000);
  EXPECT_GT(all, 1000);
}

/// What has to hold of any interval, whatever the scene.
void expect_sound(const TwinInterval& interval, Wanted wanted, const TriangleMesh& mesh_L,
                  const Pose& X_BL, const PointSpace& space, Random& random) {
  const auto counts = [&](const Eigen::Vector3d& p_B) {
    return wanted == Wanted::reading ? space.is_reading(p_B) : space.is_obstacle(p_B);
  };
  EXPECT_LE(interval.lower_m, interval.upper_m);
  EXPECT_LE(interval.lower_m, 1.0);
  if (std::isfinite(interval.upper_m)) {
    EXPECT_TRUE(counts(interval.obstacle_point_B));
    EXPECT_NEAR((interval.obstacle_point_B - interval.robot_point_B).norm(), interval.upper_m,
                1e-9);
    const auto nearest = NearestOnMesh(mesh_L)(X_BL.inverse() * interval.robot_point_B);
    EXPECT_LT(nearest.distance_m, 1e-6);
  }
  if (interval.lower_m <= 1e-6) return;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d p_B =
        draw_point(random, mesh_L, X_BL) + random(0, interval.lower_m - 1e-6) * direction;
    ASSERT_FALSE(counts(p_B)) << "nearer than the lower bound";
  }
}

void expect_sound(const RobotModel& model, const DrawnViews& drawn) {
  const PointSpace space = point_space(drawn.views, {});
  const std::vector<TwinDistance> twin = twin_distances(model, drawn.scene.pose, space, {});
  Random random(1);
  for (std::size_t i = 0; i < twin.size(); ++i) {
    SCOPED_TRACE(::testing::Message() << "link " << i + 1);
    const std::size_t link = model.evaluated_links[i];
    const TriangleMesh& mesh_L = model.links[link].mesh_L;
    const Pose& X_BL = drawn.scene.pose.X_BL[link];
    expect_sound(twin[i].nearest, Wanted::obstacle, mesh_L, X_BL, space, random);
    expect_sound(twin[i].reading, Wanted::reading, mesh_L, X_BL, space, random);
    EXPECT_LE(twin[i].nearest.lower_m, twin[i].reading.upper_m);
  }
}

TEST_F(WholeRobotTwin, IntervalsAreSoundOnDrawnScenes) {
  for (std::uint32_t seed = 0; seed < thinned(8U); ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    expect_sound(model_, draw_views(model_, trees_, kSmall, seed, 1 + static_cast<int>(seed % 4)));
  }
}

TEST_F(WholeRobotTwin, IntervalsAreSoundOnOddScenes) {
  for (const NamedViews& odd : odd_views(model_, trees_, 3)) {
    SCOPED_TRACE(odd.name);
    expect_sound(model_, odd.drawn);
  }
}

TEST_F(WholeRobotTwin, NearlyAllIntervalsAreNarrow) {
  int intervals = 0, wide = 0;
  for (std::uint32_t seed = 0; seed < thinned(6U); ++seed) {
    const DrawnViews drawn = draw_views(model_, trees_, kSmall, seed, 3);
    for (const TwinDistance& twin :
         twin_distances(model_, drawn.scene.pose, point_space(drawn.views, {}), {})) {
      for (const TwinInterval& interval : {twin.nearest, twin.reading}) {
        ++intervals;
        wide += interval.upper_m - interval.lower_m > 0.001 && interval.lower_m < 1;
      }
    }
  }
  EXPECT_LE(wide, intervals / 50);
}

/// A box of 20 cm around (x, 0, z).
TwinDistance distance_of_box(double x, double z, const PointSpace& space) {
  Pose X_BL = Pose::Identity();
  X_BL.translation() = Eigen::Vector3d(x, 0, z);
  return twin_distance(make_box({0.2, 0.2, 0.2}), X_BL, space, {});
}

void expect_near(const TwinInterval& interval, double distance_m) {
  EXPECT_LE(interval.lower_m, distance_m + 1e-6);
  EXPECT_GE(interval.upper_m, distance_m - 1e-6);
  EXPECT_LE(interval.upper_m - interval.lower_m, 0.00051);
}

TEST(WholeRobotTwinOnPaper, ABoxBeforeAWall) {
  // Turned, so that one corner is the nearest point.
  Pose X_BL = Pose::Identity();
  X_BL.linear() =
      turn_between(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  X_BL.translation().z() = 1;
  const PointSpace space({wall_at(1.5)}, {});
  const TwinDistance twin = twin_distance(make_box({0.2, 0.2, 0.2}), X_BL, space, {});
  expect_near(twin.nearest, 0.5 - 0.1 * std::numbers::sqrt3);
  expect_near(twin.reading, 0.5 - 0.1 * std::numbers::sqrt3);
}

TEST(WholeRobotTwinOnPaper, ABoxBehindAWallIsHidden) {
  const TwinDistance twin =
      distance_of_box(0, 1, PointSpace({wall_at(0.7)}, {.surface_thickness_m = 0.05}));
  expect_near(twin.nearest, 0);
  EXPECT_LE(twin.reading.lower_m, 0.15);
  EXPECT_GE(twin.reading.upper_m, 0.15);
  EXPECT_LE(twin.reading.upper_m, 0.153);
}

/// The left half of the image shows a plate at 0.5 m, whose shadow ends at x = 0 m, since pixel 20
/// is the first one right of it.
double half_plate(int u, int) { return u < 20 ? 0.5 : 3; }

TEST(WholeRobotTwinOnPaper, ABoxBesideAShadow) {
  const TwinDistance twin = distance_of_box(0.3, 1, PointSpace({flat_view(half_plate)}, {}));
  // The shadow's border is the plane x = -z / 80; the box's edge is at (0.2, 1.1).
  const double tilt = std::hypot(1, 1 / 80.0);
  EXPECT_LE(twin.nearest.lower_m, (0.2 + 0.9 / 80) / tilt);
  EXPECT_GE(twin.nearest.upper_m, (0.2 + 0.9 / 80) / tilt);
  EXPECT_LE(twin.nearest.upper_m - twin.nearest.lower_m, 0.002) << "the edge is parallel";
  // The plate's far edge in the surface layer.
  expect_near(twin.reading, std::hypot(0.2 + 0.53 / 80, 0.9 - 0.53));
}

TEST(WholeRobotTwinOnPaper, AnotherCameraSeesTheShadowFree) {
  const PointSpace space({flat_view(half_plate), wall_at(4, from_the_left(2))}, {});
  const TwinDistance twin = distance_of_box(0.3, 1, space);
  expect_near(twin.nearest, std::hypot(0.2 + 0.53 / 80, 0.9 - 0.53));
  expect_near(twin.reading, std::hypot(0.2 + 0.53 / 80, 0.9 - 0.53));
}

TEST(WholeRobotTwinOnPaper, TheShadowBeginsWhereTheOtherImageEnds) {
  const PointSpace space({flat_view(half_plate), wall_at(3, from_the_left(1))}, {});
  const TwinDistance twin = distance_of_box(0.3, 1, space);
  // The corner of three planes: the shadow's border x = -z / 80, the first image's end
  // y = z * 15.5 / 40, and the end of what the other one frees, y = (x + 1) * 14.5 / 40.
  const double z = 14.5 / (15.5 + 14.5 / 80);
  expect_near(twin.nearest, std::hypot(0.2 + z / 80, z * 15.5 / 40 - 0.1));
}

TEST(WholeRobotTwinOnPaper, ABoxBesideABall) {
  const Eigen::Vector3d ball_B(-0.1, 0, 1.2);
  const double radius_m = 0.1;
  const Camera fine{410, 310, 400, 400, 204.5, 154.5};
  PointView view = wall_at(3);
  view.camera = fine;
  view.sensor_depth_m = DepthImage(fine.width_px, fine.height_px, kNoDepth);
  view.fate = Image<PixelFate>(fine.width_px, fine.height_px, PixelFate::no_reading);
  for (int v = 0; v < fine.height_px; ++v) {
    for (int u = 0; u < fine.width_px; ++u) {
      const Eigen::Vector3d ray((u - fine.cx_px) / fine.fx_px, (v - fine.cy_px) / fine.fy_px, 1);
      const double along = ray.dot(ball_B) / ray.squaredNorm();
      const double miss2 = (along * ray - ball_B).squaredNorm();
      if (miss2 > radius_m * radius_m) continue;
      const double half = std::sqrt((radius_m * radius_m - miss2) / ray.squaredNorm());
      view.sensor_depth_m(u, v) = static_cast<float>(along - half);
      view.fate(u, v) = PixelFate::obstacle;
    }
  }
  view.obstacle_depth_m = view.sensor_depth_m;
  // The box's near face is at z = 0.4 and reaches over the ball's centre: straight ahead.
  const TwinDistance twin = distance_of_box(-0.1, 0.3, PointSpace({view}, {}));
  EXPECT_NEAR(twin.reading.upper_m, 1.2 - radius_m - 0.4, 0.001);
  EXPECT_NEAR(twin.nearest.upper_m, 1.2 - radius_m - 0.4, 0.001);
}

TEST(WholeRobotTwinOnPaper, NothingWithinTheRangeIsInfinitelyFar) {
  const TwinDistance twin = distance_of_box(0, 1, PointSpace({wall_at(2.2)}, {}));
  EXPECT_EQ(twin.nearest.lower_m, 1.0);
  EXPECT_TRUE(std::isinf(twin.nearest.upper_m));
  EXPECT_EQ(twin.reading.lower_m, 1.0);
  EXPECT_TRUE(std::isinf(twin.reading.upper_m));
}

TEST_F(WholeRobotTwin, ASearchThatIsGivenUpStaysWide) {
  const DrawnViews drawn = draw_views(model_, trees_, kSmall, 1, 3);
  const PointSpace space = point_space(drawn.views, {});
  const std::size_t link = model_.evaluated_links[3];
  const auto twin = [&](const TwinSettings& settings) {
    return twin_distance(model_.links[link].mesh_L, drawn.scene.pose.X_BL[link], space, settings)
        .nearest;
  };
  const TwinInterval whole = twin({});
  for (const TwinSettings& settings :
       {TwinSettings{.most_cubes = 100}, TwinSettings{.least_edge_m = 0.02}}) {
    const TwinInterval given_up = twin(settings);
    EXPECT_LE(given_up.lower_m, whole.upper_m);
    EXPECT_GE(given_up.upper_m, whole.lower_m);
    EXPECT_GT(given_up.upper_m - given_up.lower_m, 0.005);
  }
}

TEST(NearestOnMesh, AgreesWithFcl) {
  Random random(5);
  const TriangleMesh mesh = draw_obstacle(random, 0.3);
  const MeshTree tree = build_mesh_tree(mesh);
  const NearestOnMesh nearest(mesh);
  const MeshTree point = build_mesh_tree({{{0, 0, 0}, {1e-7F, 0, 0}, {0, 1e-7F, 0}}, {{0, 1, 2}}});
  for (int i = 0; i < 500; ++i) {
    Pose X = Pose::Identity();
    X.translation() = draw_point(random, {{0, 0, 0}, 0.6});
    const double expected_m = closest_points(tree, Pose::Identity(), point, X).distance_m;
    EXPECT_NEAR(nearest(X.translation()).distance_m, expected_m, 1e-6);
    EXPECT_TRUE(std::isinf(nearest(X.translation(), expected_m - 1e-5).distance_m));
  }
}

}  // namespace
}  // namespace berth::sim
