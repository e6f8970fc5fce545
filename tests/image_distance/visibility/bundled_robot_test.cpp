// find_visibility on the bundled arm against rays, a hundred random links of it.
#include <gtest/gtest.h>

#include "tests/image_distance/visibility/random_view.hpp"

namespace berth {
namespace {

const Camera kCamera{640, 480, 525, 530, 321.5, 236.5};
/// Standard errors of 400 points and of the twin's 4000; and pixels, which make the seen share of
/// thin links smaller.
constexpr double kLargestError = 0.065;
constexpr double kMeanSquareError = 0.025 * 0.025;
constexpr int kPlainPoints = 4000;

class BundledRobot : public ::testing::Test {
 protected:
  BundledRobot()
      : model_(load_robot({.urdf = BERTH_BUNDLED_ARM "/arm.urdf",
                           .package_paths = {{"berth_arm", BERTH_BUNDLED_ARM}},
                           .environment_links = {"table"}})),
        points_(sample_points(model_)) {}

  std::vector<LinkVisibility> find(const RandomView& view, const LinkDistances& distances) const {
    VisibilityWorkspace workspace;
    std::vector<LinkVisibility> out;
    find_visibility(model_, points_, view.frame(), view.asked(), distances, 1, workspace, out);
    return out;
  }

  RobotModel model_;
  SamplePoints points_;
};

/// Of differences of shares.
struct Errors {
  double greatest = 0;
  double squares = 0;
  double seen = 0;
  int count = 0;

  void add(const SightShares& fast, const SightShares& plain) {
    const double difference = greatest_difference(fast, plain);
    greatest = std::max(greatest, difference);
    squares += difference * difference;
    seen += fast.seen - plain.seen;
    ++count;
  }
};

TEST_F(BundledRobot, SharesOfSurfacesAreThoseOfRays) {
  Errors errors;
  SightShares most{0, 0, 0, 0, 0};
  for (std::uint32_t seed = 0; seed < 13; ++seed) {
    const RandomView view(model_, kCamera, seed);
    LinkDistances distances;
    distances.links.resize(model_.link_count());
    const std::vector<LinkVisibility> links = find(view, distances);
    for (std::size_t i = 0; i < links.size(); ++i) {
      const std::size_t link = model_.evaluated_links[i];
      const SightShares& fast = links[i].surface;
      const SightShares plain = plain_surface_shares(view.plain(), model_.links[link].mesh_L,
                                                     view.X_CL(link), kPlainPoints, seed);
      errors.add(fast, plain);
      most.seen = std::max(most.seen, plain.seen);
      most.hidden_by_obstacles = std::max(most.hidden_by_obstacles, plain.hidden_by_obstacles);
      most.hidden_by_robot = std::max(most.hidden_by_robot, plain.hidden_by_robot);
      most.no_reading = std::max(most.no_reading, plain.no_reading);
      most.outside_image = std::max(most.outside_image, plain.outside_image);
    }
  }
  RecordProperty("greatest", std::to_string(errors.greatest));
  RecordProperty("mean_square", std::to_string(errors.squares / errors.count));
  RecordProperty("seen_too_large_by", std::to_string(errors.seen / errors.count));
  EXPECT_LT(errors.greatest, kLargestError);
  EXPECT_LT(errors.squares, errors.count * kMeanSquareError);
  // What is rejected is not called seen.
  EXPECT_LT(errors.seen, 0);
  EXPECT_GT(errors.seen, -0.02 * errors.count);
  for (const float share : {most.seen, most.hidden_by_obstacles, most.hidden_by_robot,
                            most.no_reading, most.outside_image}) {
    EXPECT_GT(share, 0.1) << "the views do not show every case";
  }
}

TEST_F(BundledRobot, SharesOfBallsAreThoseOfRays) {
  Errors errors;
  for (std::uint32_t seed = 0; seed < 13; ++seed) {
    const RandomView view(model_, kCamera, seed);
    LinkDistances distances;
    distances.links.resize(model_.link_count());
    for (std::size_t i = 0; i < distances.links.size(); ++i) {
      LinkDistance& link = distances.links[i];
      link.status = LinkStatus::ok;
      link.distance_m = 0.05F * static_cast<float>(1 + i);
      link.robot_point_C_m = view.X_CL(model_.evaluated_links[i]).translation().cast<float>();
    }
    const std::vector<LinkVisibility> links = find(view, distances);
    for (std::size_t i = 0; i < links.size(); ++i) {
      const SightShares plain =
          plain_ball_shares(view.plain(), distances.links[i].robot_point_C_m.cast<double>(),
                            distances.links[i].distance_m, kPlainPoints, seed);
      errors.add(links[i].space, plain);
      EXPECT_NEAR(links[i].space_unknown, 1 - plain.seen - plain.hidden_by_obstacles, 0.06);
    }
  }
  RecordProperty("greatest", std::to_string(errors.greatest));
  RecordProperty("mean_square", std::to_string(errors.squares / errors.count));
  EXPECT_LT(errors.greatest, 0.06);
  EXPECT_LT(errors.squares, errors.count * kMeanSquareError);
}

}  // namespace
}  // namespace berth
