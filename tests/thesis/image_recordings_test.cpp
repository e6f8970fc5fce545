// Two real recordings and the range of each link's distance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "lab/filter/expected_ranges.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/mounted_with.hpp"
#include "thesis/image_query.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

class ImageRecording : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    folder_ = data_folder() / "recordings" / GetParam();
    if (!fs::exists(folder_ / "scene.yaml"))
      GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
  }
  fs::path folder_;
};

TEST_P(ImageRecording, NoLinkIsTooFarAndMostAreInTheirRange) {
  const OpenScene scene = open_scene(folder_ / "scene.yaml");
  const OpenCamera& camera = scene.cameras.front();
  const lab::ExpectedRanges ranges = lab::read_expected_ranges(folder_ / "expected.tsv");
  const std::vector<std::string> names = camera.mounted->robot()->model().evaluated_link_names();
  Observer observer(camera.mounted);
  ImageQuery query(scene.robot, Method::exact);
  Frame frame;
  int checked = 0;
  int inside = 0;
  int free_links_at_contact = 0;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
    for (const LinkResult& link : query.ask(frame).links) {
      const auto range = ranges.find({static_cast<int>(i), names[link.id - 1]});
      ASSERT_NE(range, ranges.end()) << names[link.id - 1];
      const auto& [min_m, max_m, is_checked] = range->second;
      const bool is_inside = link.distance_m >= min_m && link.distance_m <= max_m;
      fmt::print("{} frame {} {:<11} {:.4f} m, expected {:.3f} to {:.3f} m ({}){}\n", GetParam(), i,
                 names[link.id - 1], link.distance_m, min_m, max_m,
                 is_checked ? "checked" : "estimate", is_inside ? "" : "  <- outside");
      EXPECT_EQ(link.status, LinkStatus::ok) << "frame " << i << ", " << names[link.id - 1];
      EXPECT_LE(link.distance_m, max_m + lab::kFarMargin_m)
          << "frame " << i << ", " << names[link.id - 1];
      free_links_at_contact += min_m >= 0.05 && link.distance_m < 0.03;
      checked += is_checked;
      inside += is_checked && is_inside;
    }
  }
  EXPECT_GE(inside, 0.8 * checked);
  EXPECT_EQ(free_links_at_contact, 0);
}

/// The camera again, its view with these rules.
std::shared_ptr<const MountedCamera> with_rules(const OpenCamera& camera,
                                                const SensorSettings& rules) {
  CameraSettings settings = camera.mounted->settings();
  settings.sensor = rules;
  return testing::mounted_with(*camera.mounted, settings);
}

TEST_P(ImageRecording, SpeckleAndBackgroundMakeNoDistanceLarger) {
  const OpenScene scene = open_scene(folder_ / "scene.yaml");
  const OpenCamera& camera = scene.cameras.front();
  SensorSettings rules;
  rules.speckle_px = 20;
  rules.background_frames = 2;
  const auto ruled = with_rules(camera, rules);
  Observer observer(camera.mounted), ruled_observer(ruled);
  ImageQuery query(scene.robot, Method::exact);
  ImageQuery ruled_query(scene.robot, Method::exact);
  Frame frame;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    const DepthImage depth_m = camera.read_depth(i);
    observer.observe(depth_m, camera.at_exposure[i], frame);
    ruled_observer.learn_background(depth_m, frame);
  }
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    const DepthImage depth_m = camera.read_depth(i);
    observer.observe(depth_m, camera.at_exposure[i], frame);
    const ImageResult before = query.ask(frame);
    ruled_observer.observe(depth_m, camera.at_exposure[i], frame);
    EXPECT_GT(frame.obstacles.count_of(PixelFate::speckle), 0);
    const ImageResult& after = ruled_query.ask(frame);
    for (std::size_t k = 0; k < before.links.size(); ++k)
      EXPECT_LE(after.links[k].distance_m, before.links[k].distance_m) << i << ", link " << k + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(Real, ImageRecording,
                         ::testing::Values("xarm7_realsense", "lbr_med7_zed2i"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace berth
