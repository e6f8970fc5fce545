// What cameras see of many points at once, beside a plain count of one point after the other.
#include "berth/visibility/line_of_sight.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/random.hpp"
#include "tests/support/only_target.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

constexpr int kWidth_px = 61, kHeight_px = 43;

/// Images of one camera, pixels at random: all fates, with and without readings.
struct DrawnView {
  Camera camera{kWidth_px, kHeight_px, 55, 50, 29.3, 20.8};
  RobotImage robot{DepthImage(kWidth_px, kHeight_px, 0), Image<LinkId>(kWidth_px, kHeight_px, 0)};
  ObstacleImage obstacles;
  UnitImage sensor_depth{kWidth_px, kHeight_px, 0};
  Pose X_CB = Pose::Identity();

  explicit DrawnView(sim::Random& random) {
    obstacles.depth_m = DepthImage(kWidth_px, kHeight_px, kNoDepth);
    obstacles.fate = Image<PixelFate>(kWidth_px, kHeight_px, PixelFate::no_reading);
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) draw_pixel(random, u, v);
    }
    X_CB.translation() = sim::draw_point(random, 0.4) + Eigen::Vector3d(0, 0, 1.5);
    X_CB.linear() = Eigen::AngleAxisd(random(-0.6, 0.6), sim::draw_point(random, 1).normalized())
                        .toRotationMatrix();
  }

  void draw_pixel(sim::Random& random, int u, int v) {
    const auto fate = static_cast<PixelFate>(random.whole(0, kPixelFateCount - 1));
    const bool has_none = fate == PixelFate::no_reading || fate == PixelFate::hole;
    const auto reading_m = static_cast<float>(random(0.5, 2.5));
    obstacles.fate(u, v) = fate;
    sensor_depth(u, v) = has_none ? kEndlessUnits : units_of(reading_m);
    if (is_kept(fate)) obstacles.depth_m(u, v) = static_cast<float>(random(0.5, 2.5));
    robot.depth_m(u, v) = random.chance(0.5) ? kNoDepth : static_cast<float>(random(0.5, 2.5));
  }

  SeeingCamera seeing() const {
    return {{camera, robot, obstacles, Tolerance{0.02F, 0.004F}}, sensor_depth, X_CB};
  }
};

/// As the comment at count_surface_sights() says.
Sight plain_surface_sight(const SeeingCamera& view, const Eigen::Vector3d& p_C_m) {
  const std::optional<Pixel> pixel = pixel_of(view.frame.camera, p_C_m);
  if (!pixel) return Sight::outside_image;
  if (view.sensor_depth(pixel->u, pixel->v) == kEndlessUnits) return Sight::no_reading;
  const float reading_m = in_metres(view.sensor_depth(pixel->u, pixel->v));
  const float least_m = view.frame.tolerance.least_reading_m(static_cast<float>(p_C_m.z()));
  const PixelFate fate = view.frame.obstacles.fate(pixel->u, pixel->v);
  if (is_kept(fate)) {
    const bool is_before = view.frame.obstacles.depth_m(pixel->u, pixel->v) < least_m;
    return is_before ? Sight::hidden_by_obstacles : Sight::seen;
  }
  if (fate != PixelFate::robot && fate != PixelFate::environment) return Sight::no_reading;
  return reading_m < least_m ? Sight::hidden_by_robot : Sight::seen;
}

Sight plain_space_sight(const SeeingCamera& view, const Eigen::Vector3d& p_C_m) {
  return sight_of_space(view.frame, p_C_m);
}

/// Counts by a plain function, and how many points lie so near to a border that single precision
/// may say otherwise.
struct PlainCount {
  std::array<int, kSightCount> of{};
  int doubtful = 0;
};

template <class SightIn>
PlainCount plain_count(const std::vector<SeeingCamera>& views,
                       const std::vector<Eigen::Vector3d>& points_B_m, SightIn sight_in) {
  const auto best = [&](const Eigen::Vector3d& p_B_m) {
    Sight found = Sight::outside_image;
    for (const SeeingCamera& view : views)
      found = std::min(found, sight_in(view, view.X_CB * p_B_m));
    return found;
  };
  PlainCount count;
  for (const Eigen::Vector3d& p_B_m : points_B_m) {
    const Sight found = best(p_B_m);
    ++count.of[static_cast<std::size_t>(found)];
    bool is_doubtful = false;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      is_doubtful |= best(p_B_m + 4e-6 * sign) != found;
    }
    count.doubtful += is_doubtful;
  }
  return count;
}

PointLanes lanes_of(const std::vector<Eigen::Vector3d>& points_m) {
  PointLanes lanes;
  lanes.count = static_cast<int>(points_m.size());
  for (std::size_t i = 0; i < points_m.size() + PointLanes::kMostLanes; ++i) {
    for (int k = 0; k < 3; ++k) {
      lanes.at_m[k].push_back(static_cast<float>(points_m[i % points_m.size()][k]));
    }
  }
  return lanes;
}

std::array<int, kSightCount> counts_of(const SightCount& count) {
  std::array<int, kSightCount> of{};
  for (int i = 0; i < kSightCount; ++i) of[i] = count.count(static_cast<Sight>(i));
  return of;
}

void expect_same(const SightCount& found, const PlainCount& plain, int points) {
  EXPECT_EQ(found.sum(), points);
  for (int i = 0; i < kSightCount; ++i) {
    EXPECT_NEAR(found.count(static_cast<Sight>(i)), plain.of[i], plain.doubtful) << "sight " << i;
  }
}

TEST(Sights, AreThoseOfThePlainCountOnEveryInstructionSet) {
  sim::Random random(7);
  int doubtful = 0, all = 0;
  std::array<int, kSightCount> with_sight{};
  for (int i = 0; i < thinned(60); ++i) {
    SCOPED_TRACE(i);
    std::vector<DrawnView> drawn;
    for (int k = 0; k < 1 + i % 4; ++k) drawn.emplace_back(random);
    std::vector<SeeingCamera> views;
    for (const DrawnView& view : drawn) views.push_back(view.seeing());
    std::vector<Eigen::Vector3d> a_m, b_m, points_B_m;
    const int count = random.whole(1, kSamplePoints);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random(-3, 3), sim::draw_point(random, 1).normalized())
            .toRotationMatrix();
    const Eigen::Vector3d origin_m = sim::draw_point(random, 0.2);
    const double radius_m = random(0, 0.5);
    for (int k = 0; k < count; ++k) {
      a_m.push_back(sim::draw_point(random, 0.6));
      b_m.push_back(sim::draw_point(random, 1));
      points_B_m.push_back(origin_m + turn * a_m.back() + radius_m * b_m.back());
    }
    const PointLanes a = lanes_of(a_m), b = lanes_of(b_m);
    PlacedPoints placed;
    placed.count = count;
    placed.origin_B_m = origin_m.cast<float>();
    placed.parts[0] = {&a, turn.cast<float>()};
    placed.parts[1] = {&b, static_cast<float>(radius_m) * Eigen::Matrix3f::Identity()};
    const PlainCount surface = plain_count(views, points_B_m, plain_surface_sight);
    const PlainCount space = plain_count(views, points_B_m, plain_space_sight);
    const auto surface_first = counts_of(count_surface_sights(views, placed));
    const auto space_first = counts_of(count_space_sights(views, placed));
    on_every_target([&](const char* target) {
      SCOPED_TRACE(target);
      const SightCount of_surface = count_surface_sights(views, placed);
      const SightCount of_space = count_space_sights(views, placed);
      expect_same(of_surface, surface, count);
      expect_same(of_space, space, count);
      EXPECT_EQ(counts_of(of_surface), surface_first);
      EXPECT_EQ(counts_of(of_space), space_first);
    });
    doubtful += surface.doubtful + space.doubtful;
    all += 2 * count;
    for (int k = 0; k < kSightCount; ++k) with_sight[k] += surface.of[k] + space.of[k];
  }
  EXPECT_LT(doubtful, 0.01 * all);
  for (const int count : with_sight) EXPECT_GT(count, all / 100);
}

TEST(Sights, OfNoPointsAreNone) {
  sim::Random random(8);
  const DrawnView drawn(random);
  const std::vector<SeeingCamera> views{drawn.seeing()};
  EXPECT_EQ(count_surface_sights(views, {}).sum(), 0);
  EXPECT_EQ(count_space_sights(views, {}).sum(), 0);
}

TEST(Sights, WithoutAViewAllPointsAreOutside) {
  const PointLanes points = lanes_of({{0, 0, 1}, {1, 0, 1}});
  PlacedPoints placed;
  placed.count = 2;
  placed.parts[0] = {&points, Eigen::Matrix3f::Identity()};
  EXPECT_EQ(count_surface_sights({}, placed).count(Sight::outside_image), 2);
}

}  // namespace
}  // namespace berth
