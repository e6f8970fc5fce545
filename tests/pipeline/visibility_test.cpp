// What answers tell of what the camera cannot know, on the bundled scene.
#include <gtest/gtest.h>

#include <thread>

#include "berth/scene/open_scene.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "tests/support/view_with.hpp"
#include "tests/pipeline/web.hpp"

namespace berth {
namespace {

/// The shares of all links, one after the other; NaN as -1, so that they can be compared.
std::vector<float> shares_of(const Answer& answer) {
  std::vector<float> shares;
  for (const LinkVisibility& link : answer.visibility) {
    for (const SightShares& part : {link.surface, link.space}) {
      for (const float share : {part.seen, part.hidden_by_obstacles, part.hidden_by_robot,
                                part.no_reading, part.outside_image})
        shares.push_back(std::isnan(share) ? -1 : share);
    }
  }
  return shares;
}

class VisibilityOfAnswers : public ::testing::Test {
 protected:
  VisibilityOfAnswers()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml")),
        camera_(scene_.cameras.front()) {
    Observer(camera_.view).observe(camera_.read_depth(3), camera_.at_exposure[3], frame_);
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  Frame frame_;
};

TEST_F(VisibilityOfAnswers, TheJointsOfTheExposureGiveTheSharesOfTheExposure) {
  Asker asker(camera_.view->robot());
  const auto at_exposure = shares_of(asker.ask(frame_));
  ASSERT_EQ(at_exposure.size(), 8U * 10);
  const auto later = shares_of(asker.ask(frame_, camera_.at_exposure[20]));
  EXPECT_NE(later, at_exposure);
  EXPECT_EQ(shares_of(asker.ask(frame_, camera_.at_exposure[3])), at_exposure);
}

TEST_F(VisibilityOfAnswers, LinksAreInTheOrderOfTheirIdsAndSeenInPart) {
  Asker asker(camera_.view->robot());
  const Answer& answer = asker.ask(frame_);
  for (std::size_t i = 0; i < answer.visibility.size(); ++i) {
    EXPECT_EQ(answer.visibility[i].id, i + 1);
    EXPECT_GT(answer.visibility[i].surface.seen, 0);
    EXPECT_LT(answer.visibility[i].surface.seen, 0.5);
    EXPECT_EQ(answer.visibility[i].surface.outside_image, 0);
    EXPECT_GT(answer.visibility[i].space_unknown, 0);
  }
}

TEST_F(VisibilityOfAnswers, OffLeavesThemOutAndChangesNoDistance) {
  SceneFile file = read_scene(BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml");
  file.evaluation.visibility = false;
  const OpenScene off = open_scene(file);
  Asker asker(camera_.view->robot());
  Asker asker_off(off.robot);
  const Answer& answer = asker.ask(frame_);
  const Answer& answer_off = asker_off.ask(frame_);
  EXPECT_TRUE(answer_off.visibility.empty());
  for (std::size_t i = 0; i < answer.distances.links.size(); ++i) {
    EXPECT_EQ(answer_off.distances.links[i].distance_m, answer.distances.links[i].distance_m);
  }
}

TEST_F(VisibilityOfAnswers, TwoThreadsAskOneFrame) {
  std::vector<float> shares[2];
  const auto ask = [&](std::vector<float>& out) {
    Asker asker(camera_.view->robot());
    for (int i = 0; i < 20; ++i) out = shares_of(asker.ask(frame_, camera_.at_exposure[8]));
  };
  std::thread other(ask, std::ref(shares[0]));
  ask(shares[1]);
  other.join();
  EXPECT_EQ(shares[0], shares[1]);
  EXPECT_FALSE(shares[0].empty());
}

TEST_F(VisibilityOfAnswers, WithWhatIsDoubtfulDistancesAreThoseWithoutTheIslandRule) {
  DepthImage with_web_m = camera_.read_depth(3);
  draw_web(frame_.robot, with_web_m);
  ViewSettings settings = camera_.view->settings();
  settings.self_filter.island_radius_m = 0;
  const auto no_islands = testing::view_with(*camera_.view, settings);
  Observer observer(camera_.view);
  Observer observer_of_all(no_islands);
  Asker asker(camera_.view->robot());
  Asker asker_of_all(no_islands->robot());
  Frame all;
  observer.observe(with_web_m, camera_.at_exposure[3], frame_);
  observer_of_all.observe(with_web_m, camera_.at_exposure[3], all);
  ASSERT_GT(frame_.obstacles.count_of(PixelFate::island), 100);
  for (const std::size_t asked : {3, 6}) {
    const Answer& answer = asker.ask(frame_, camera_.at_exposure[asked]);
    const Answer& answer_of_all = asker_of_all.ask(all, camera_.at_exposure[asked]);
    int doubts = 0;
    for (std::size_t i = 0; i < answer.visibility.size(); ++i) {
      const bool has_doubt = !std::isnan(answer.visibility[i].doubtful_distance_m);
      const LinkDistance& link = answer.distances.links[i];
      EXPECT_NEAR(has_doubt ? answer.visibility[i].doubtful_distance_m : link.distance_m,
                  answer_of_all.distances.links[i].distance_m, 1e-5);
      EXPECT_TRUE(std::isnan(answer_of_all.visibility[i].doubtful_distance_m));
      doubts += has_doubt;
    }
    EXPECT_GT(doubts, 0) << "joints " << asked;
  }
  observer.observe(camera_.read_depth(3), camera_.at_exposure[3], frame_);
  for (const LinkVisibility& link : asker.ask(frame_).visibility) {
    EXPECT_TRUE(std::isnan(link.doubtful_distance_m)) << "of the image before";
  }
}

}  // namespace
}  // namespace berth
