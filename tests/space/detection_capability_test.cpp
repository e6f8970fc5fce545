// Balls in rooms: where the images allow one, it is not called free.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "berth/space/unknown_space.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/sensor_model.hpp"
#include "sim/shapes.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

struct SeenRoom {
  Camera camera;
  Pose X_BC;
  /// What an ideal camera sees.
  DepthImage ideal_m;
  /// Where the robot is what it sees.
  Image<std::uint8_t> is_robot;
  CameraSpace space;
  ObstacleImage obstacles;
};

struct BallCount {
  int drawn = 0;
  /// No image reports that there is none.
  int possible = 0;
  /// A reading before the ball frees some of it: its error is above the margin, or it is the
  /// robot's.
  int at_fault = 0;
  /// Of the others: some of it is called free; its middle is; all of it is.
  int partly = 0;
  int inner = 0;
  int middle = 0;
  int wholly = 0;
};

std::vector<sim::DrawnObstacle> draw_room(sim::Random& random) {
  std::vector<sim::DrawnObstacle> room;
  room.push_back({sim::make_cuboid({6, 6, 4}), sim::translation(0, 0, 1)});
  for (int i = 0; i < 9; ++i) {
    Pose X_BO = sim::translation(random(-0.9, 0.9), random(-0.9, 0.9), random(-0.9, 0.9));
    X_BO.linear() = sim::draw_rotation(random).toRotationMatrix();
    room.push_back({sim::draw_obstacle(random, random(0.03, 0.35)), X_BO});
  }
  return room;
}

Pose draw_place(sim::Random& random) {
  const double around = random(-3.14, 3.14), up = random(0, 0.9);
  const Eigen::Vector3d away(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                             std::sin(up));
  const Eigen::Vector3d z = -away;
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose X_BC;
  X_BC.linear() << x, z.cross(x), z;
  X_BC.translation() = random(1.3, 2.6) * away + sim::draw_point(random, 0.2);
  return X_BC;
}

/// The last `robots` things of the room are the robot's.
void look(SeenRoom& view, const std::vector<sim::DrawnObstacle>& room, int robots,
          const sim::SensorErrors& errors, std::uint32_t seed) {
  view.ideal_m = sim::cast_obstacles(room, view.camera, view.X_BC);
  view.is_robot = Image<std::uint8_t>(view.camera.width_px, view.camera.height_px, 0);
  const DepthImage robot_m =
      sim::cast_obstacles({room.end() - robots, room.end()}, view.camera, view.X_BC);
  for (std::size_t i = 0; i < robot_m.pixels().size(); ++i) {
    view.is_robot.pixels()[i] = robot_m.pixels()[i] < view.ideal_m.pixels()[i] + 1e-4F;
  }
  DepthImage sensed_m = view.ideal_m;
  sim::add_errors(errors, seed, sensed_m);
  view.obstacles.depth_m = sensed_m;
  view.obstacles.fate = Image<PixelFate>(sensed_m.width(), sensed_m.height(), PixelFate::obstacle);
  for (std::size_t i = 0; i < sensed_m.pixels().size(); ++i) {
    PixelFate& fate = view.obstacles.fate.pixels()[i];
    if (std::isnan(sensed_m.pixels()[i])) {
      fate = PixelFate::no_reading;
    } else if (view.is_robot.pixels()[i] != 0) {
      fate = PixelFate::robot;
      view.obstacles.depth_m.pixels()[i] = kNoDepth;
    }
  }
  build_camera_space(view.camera, sensed_m, view.obstacles, {}, {}, view.space);
}

/// What one image says of a ball.
struct Verdict {
  bool is_possible = true;
  bool is_at_fault = false;
};

/// At least those that a ball before the lens covers.
PixelRect pixels_around(const Camera& camera, const Eigen::Vector3d& c, double radius_m) {
  if (c.z() < 2 * radius_m) return {0, 0, camera.width_px, camera.height_px};
  const ImagePoint middle = project(camera, c);
  const double reach_px = 2 + 2 * camera.fx_px * radius_m / (c.z() - radius_m);
  return clip(
      {static_cast<int>(middle.u - reach_px), static_cast<int>(middle.v - reach_px),
       static_cast<int>(middle.u + reach_px) + 1, static_cast<int>(middle.v + reach_px) + 1},
      camera.width_px, camera.height_px);
}

Verdict judge(const SeenRoom& view, const Eigen::Vector3d& centre_B, double radius_m) {
  const Eigen::Vector3d c = view.X_BC.inverse() * centre_B;
  const Camera& camera = view.camera;
  if (c.z() < -radius_m) return {};
  Verdict verdict;
  const PixelRect around = pixels_around(camera, c, radius_m);
  for (int v = around.v_begin; v < around.v_end; ++v) {
    for (int u = around.u_begin; u < around.u_end; ++u) {
      const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px,
                                (v - camera.cy_px) / camera.fy_px, 1);
      const double a = ray.squaredNorm(), b = ray.dot(c);
      const double under = b * b - a * (c.squaredNorm() - radius_m * radius_m);
      // Of a camera in the ball, what is before the lens.
      if (under <= 0 || (b <= 0 && c.norm() > radius_m)) continue;
      const double front_m = (b - std::sqrt(under)) / a;
      const float sensed_m = in_metres(view.space.sensor_depth(u, v));
      const bool is_read = std::isfinite(sensed_m);
      if (is_read && view.ideal_m(u, v) > front_m) return {false, false};
      // What the robot hides is no obstacle, up to 30 cm behind it.
      const float own_m = !is_read ? 0 : sensed_m + (view.is_robot(u, v) != 0 ? 0.3f : -0.02f);
      verdict.is_at_fault |= own_m > front_m;
    }
  }
  return verdict;
}

bool is_free(const std::vector<SeenRoom>& views, const Eigen::Vector3d& p_B) {
  for (const SeenRoom& view : views) {
    const FreeingCamera camera{&view.space, view.X_BC, view.X_BC.inverse(), 0,
                               &view.space.free_depth};
    if (is_seen_free(camera, p_B)) return true;
  }
  return false;
}

void put_ball(const std::vector<SeenRoom>& views, const Eigen::Vector3d& centre_B, double radius_m,
              BallCount& count) {
  ++count.drawn;
  Verdict all;
  for (const SeenRoom& view : views) {
    const Verdict verdict = judge(view, centre_B, radius_m);
    if (!verdict.is_possible) return;
    all.is_at_fault |= verdict.is_at_fault;
  }
  ++count.possible;
  if (all.is_at_fault) {
    ++count.at_fault;
    return;
  }
  const bool middle = is_free(views, centre_B);
  int free = middle, points = 1, inner = 0;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;
    const Eigen::Vector3d direction =
        Eigen::Vector3d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1).normalized();
    for (const double share : {0.5, 0.99}) {
      const bool is = is_free(views, centre_B + share * radius_m * direction);
      free += is;
      inner += is && share < 0.9;
      ++points;
    }
  }
  count.middle += middle;
  count.inner += inner > 0;
  count.partly += free > 0;
  count.wholly += free == points;
}

/// Where not the default: images of half the size, balls of this share of what the cameras tell,
/// things that are the robot.
struct Room {
  bool is_coarse = false;
  double share = 1;
  int robots = 0;
};

Camera draw_camera(sim::Random& random, bool is_coarse) {
  if (is_coarse) return {160, 120, random(90, 165), random(90, 165), 79.5, 59.5};
  return {320, 240, random(220, 330), random(220, 330), 159.5, 119.5};
}

/// Of the one that shows the least.
double told_m(const std::vector<SeenRoom>& views) {
  double told_m = 0;
  for (const SeenRoom& view : views) {
    told_m = std::max(told_m, detection_capability_m({}, view.camera));
  }
  return told_m;
}

BallCount count_balls(const sim::SensorErrors& errors, int rooms, const Room& with = {}) {
  constexpr int kBallsPerRoom = 2500;
  BallCount count;
  for (int seed = 0; seed < rooms; ++seed) {
    sim::Random random(static_cast<std::uint32_t>(seed));
    const auto room = draw_room(random);
    std::vector<SeenRoom> views(3);
    for (SeenRoom& view : views) {
      view.camera = draw_camera(random, with.is_coarse);
      view.X_BC = draw_place(random);
      look(view, room, with.robots, errors, random.whole(0, 1000000));
    }
    for (int i = 0; i < kBallsPerRoom; ++i) {
      put_ball(views, sim::draw_point(random, 1.2), with.share * told_m(views) / 2, count);
    }
  }
  return count;
}

void expect_sound(const char* name, const sim::SensorErrors& errors, const Room& with = {}) {
  const char* const full = std::getenv("BERTH_BALLS");
  const bool is_full = full && std::string_view(full) == "full";
  const BallCount count = count_balls(errors, is_full ? 400 : thinned(20), with);
  fmt::print(
      "{}: {} balls, {} that no image excludes, {} of them behind a reading that is wrong by more "
      "than the margin, or the robot's; of the others partly free {}, nearer to the middle than "
      "half the radius "
      "{}, "
      "the middle {}, wholly {}\n",
      name, count.drawn, count.possible, count.at_fault, count.partly, count.inner, count.middle,
      count.wholly);
  EXPECT_GT(count.possible - count.at_fault, thinned(500));
  EXPECT_EQ(count.middle, 0);
  EXPECT_EQ(count.wholly, 0);
}

TEST(DetectionCapability, NoBallIsCalledFreeInCleanImages) { expect_sound("clean", {}); }

TEST(DetectionCapability, NoBallIsCalledFreeInImagesWithDarkOutlinesAndDropouts) {
  expect_sound("dark", {.dropout_share = 0.02, .outline_px = 2});
}

TEST(DetectionCapability, NoBallIsCalledFreeInNoisyImages) {
  expect_sound("sensor", sim::kKinectErrors);
}

TEST(DetectionCapability, NoBallBesideTheRobotIsCalledFree) {
  expect_sound("dark, three things are the robot", {.dropout_share = 0.02, .outline_px = 2},
               {.robots = 3});
}

TEST(DetectionCapability, NoBallIsCalledFreeInCoarseImages) {
  expect_sound("coarse, dark, three things are the robot", {.dropout_share = 0.02, .outline_px = 2},
               {.is_coarse = true, .robots = 3});
}

TEST(DetectionCapability, FollowsACoarseCameraUnlessItIsSet) {
  const auto told_m = [](double focal_px, SpaceSettings settings = {}) {
    return detection_capability_m(settings, {320, 240, focal_px, focal_px + 100, 159.5, 119.5});
  };
  EXPECT_EQ(told_m(580), 0.04);
  EXPECT_EQ(told_m(228), 0.04);
  EXPECT_EQ(told_m(227), 0.05);
  EXPECT_EQ(told_m(130), 0.08);
  EXPECT_EQ(told_m(130, {.detection_capability_m = 0.04}), 0.04);
  EXPECT_EQ(told_m(580, {.detection_capability_m = 0.0}), 0.0);
}

/// Else the tests above would find nothing either if there was something.
TEST(DetectionCapability, BallsThatAreSmallerAreFreed) {
  const BallCount count =
      count_balls({.dropout_share = 0.1, .outline_px = 2}, thinned(10), {.share = 0.1});
  EXPECT_GT(count.middle, 0);
}

}  // namespace
}  // namespace berth::testing
