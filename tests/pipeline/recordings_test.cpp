// Two real recordings with what is known of them: masks of the robot, and the range of each link's
// distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "berth/files/png.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "lab/filter/expected_ranges.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// The share of the mask's pixels with a reading that were filtered out.
double filtered_share(const Image<LinkId>& mask, const ObstacleImage& obstacles) {
  std::int64_t with_reading = 0;
  std::int64_t filtered = 0;
  for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
    const PixelFate fate = obstacles.fate.pixels()[i];
    if (mask.pixels()[i] == 0 || fate == PixelFate::no_reading) continue;
    ++with_reading;
    filtered += fate != PixelFate::obstacle;
  }
  return static_cast<double>(filtered) / static_cast<double>(with_reading);
}

class Recording : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = data_folder() / "recordings" / GetParam();
    if (!fs::exists(folder_ / "scene.yaml"))
      GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
  }
  fs::path folder_;
};

TEST_P(Recording, AtLeast99PercentOfTheRobotIsFiltered) {
  const OpenScene scene = open_scene(folder_ / "scene.yaml");
  const OpenCamera& camera = scene.cameras.front();
  Observer observer(camera.mounted);
  Frame frame;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
    const auto mask = read_link_ids_png(folder_ / fmt::format("reference/robot_mask_{:06}.png", i),
                                        camera.mounted->camera());
    const double share = filtered_share(mask, frame.obstacles);
    fmt::print("{} frame {}: {:.2f} % of the mask filtered\n", GetParam(), i, 100 * share);
    EXPECT_GE(share, 0.99) << "frame " << i;
  }
}

TEST_P(Recording, NoLinkIsTooFarFromReadingsAsAWhole) {
  const OpenScene scene = open_scene(folder_ / "scene.yaml");
  const OpenCamera& camera = scene.cameras.front();
  const lab::ExpectedRanges ranges = lab::read_expected_ranges(folder_ / "expected.tsv");
  const std::vector<std::string> names = scene.robot->model().evaluated_link_names();
  Observer observer(camera.mounted);
  Query query(scene.robot);
  Frame frame;
  int rows = 0;
  int inside = 0;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
    for (const LinkResult& link : query.ask({frame}).links) {
      const lab::ExpectedRange& range = ranges.at({static_cast<int>(i), names[link.id - 1]});
      const float distance_m = link.occupied.distance_m;
      EXPECT_LE(distance_m, range.max_m + lab::kFarMargin_m)
          << "frame " << i << ", " << names[link.id - 1];
      EXPECT_LE(link.distance_m, distance_m);
      ++rows;
      inside += distance_m >= range.min_m && distance_m <= range.max_m;
    }
  }
  fmt::print("{}: {} of {} rows in range\n", GetParam(), inside, rows);
  EXPECT_GE(inside, 0.8 * rows);
}

INSTANTIATE_TEST_SUITE_P(Real, Recording, ::testing::Values("xarm7_realsense", "lbr_med7_zed2i"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace berth
