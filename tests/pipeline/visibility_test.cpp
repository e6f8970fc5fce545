// What results tell of what the camera cannot know, on the bundled scene.
#include <gtest/gtest.h>

#include <thread>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/any_query.hpp"
#include "tests/pipeline/flying_pixels.hpp"
#include "tests/support/view_with.hpp"

namespace berth {
namespace {

/// The shares of all links, one after the other; NaN as -1, so that they can be compared.
std::vector<float> shares_of(const Result& result) {
  std::vector<float> shares;
  for (const LinkResult& link : result.links) {
    for (const SightShares& part : {link.visibility.surface, link.visibility.space}) {
      for (const float share : {part.seen, part.hidden_by_obstacles, part.hidden_by_robot,
                                part.no_reading, part.outside_image})
        shares.push_back(std::isnan(share) ? -1 : share);
    }
  }
  return shares;
}

class VisibilityOfResults : public ::testing::Test {
 protected:
  VisibilityOfResults()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {
    Observer(camera_.view).observe(camera_.read_depth(3), camera_.at_exposure[3], frame_);
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  Frame frame_;
};

TEST_F(VisibilityOfResults, TheJointsOfTheExposureGiveTheSharesOfTheExposure) {
  ImageQuery query(scene_.robot, Method::exact);
  const auto at_exposure = shares_of(query.ask(frame_));
  ASSERT_EQ(at_exposure.size(), 8U * 10);
  const auto later = shares_of(query.ask(frame_, camera_.at_exposure[20]));
  EXPECT_NE(later, at_exposure);
  EXPECT_EQ(shares_of(query.ask(frame_, camera_.at_exposure[3])), at_exposure);
}

TEST_F(VisibilityOfResults, LinksAreInTheOrderOfTheirIdsAndSeenInPart) {
  ImageQuery query(scene_.robot, Method::exact);
  const Result& result = query.ask(frame_);
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    const LinkVisibility& visibility = result.links[i].visibility;
    EXPECT_EQ(visibility.id, i + 1);
    EXPECT_GT(visibility.surface.seen, 0);
    EXPECT_LT(visibility.surface.seen, 0.5);
    EXPECT_EQ(visibility.surface.outside_image, 0);
    EXPECT_GT(visibility.space_unknown, 0);
  }
}

TEST_F(VisibilityOfResults, OffLeavesThemOutAndChangesNoDistance) {
  SceneFile file = read_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  file.evaluation.visibility = false;
  const OpenScene off = open_scene(file);
  ImageQuery query(scene_.robot, Method::exact);
  ImageQuery query_off(off.robot, Method::exact);
  const Result& result = query.ask(frame_);
  const Result& result_off = query_off.ask(frame_);
  EXPECT_TRUE(result.has_visibility);
  EXPECT_FALSE(result_off.has_visibility);
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    EXPECT_FALSE(result_off.links[i].visibility.surface.is_known());
    EXPECT_EQ(result_off.links[i].distance_m, result.links[i].distance_m);
  }
}

TEST_F(VisibilityOfResults, TwoThreadsAskOneFrame) {
  std::vector<float> shares[2];
  const auto ask = [&](std::vector<float>& out) {
    ImageQuery query(scene_.robot, Method::exact);
    for (int i = 0; i < 20; ++i) out = shares_of(query.ask(frame_, camera_.at_exposure[8]));
  };
  std::thread other(ask, std::ref(shares[0]));
  ask(shares[1]);
  other.join();
  EXPECT_EQ(shares[0], shares[1]);
  EXPECT_FALSE(shares[0].empty());
}

TEST_F(VisibilityOfResults, WithWhatIsRejectedDistancesAreThoseWithoutTheFlyingPatchRule) {
  DepthImage with_flying_pixels_m = camera_.read_depth(3);
  draw_flying_pixels(frame_.robot, with_flying_pixels_m);
  CameraSettings settings = camera_.view->settings();
  settings.self_filter.flying_patch_radius_m = 0;
  const auto no_flying_patches = testing::view_with(*camera_.view, settings);
  Observer observer(camera_.view);
  Observer observer_of_all(no_flying_patches);
  ImageQuery query(scene_.robot, Method::exact);
  ImageQuery query_of_all(no_flying_patches->robot(), Method::exact);
  Frame all;
  observer.observe(with_flying_pixels_m, camera_.at_exposure[3], frame_);
  observer_of_all.observe(with_flying_pixels_m, camera_.at_exposure[3], all);
  ASSERT_GT(frame_.obstacles.count_of(PixelFate::flying_patch), 100);
  for (const std::size_t asked : {3, 6}) {
    const Result& result = query.ask(frame_, camera_.at_exposure[asked]);
    const Result& result_of_all = query_of_all.ask(all, camera_.at_exposure[asked]);
    int rejected_readings = 0;
    for (std::size_t i = 0; i < result.links.size(); ++i) {
      const LinkResult& link = result.links[i];
      const bool has_rejected = !std::isnan(link.visibility.rejected_distance_m);
      EXPECT_NEAR(has_rejected ? link.visibility.rejected_distance_m : link.distance_m,
                  result_of_all.links[i].distance_m, 1e-5);
      EXPECT_TRUE(std::isnan(result_of_all.links[i].visibility.rejected_distance_m));
      rejected_readings += has_rejected;
    }
    EXPECT_GT(rejected_readings, 0) << "joints " << asked;
  }
  observer.observe(camera_.read_depth(3), camera_.at_exposure[3], frame_);
  for (const LinkResult& link : query.ask(frame_).links) {
    EXPECT_TRUE(std::isnan(link.visibility.rejected_distance_m)) << "of the image before";
  }
}

}  // namespace
}  // namespace berth
