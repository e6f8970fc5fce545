// What answers tell of what the camera cannot know, on the bundled scene.
#include <gtest/gtest.h>

#include <thread>

#include "apps/berth/open_scene.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"

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

class VisibilityOfAnswers : public testing::Test {
 protected:
  VisibilityOfAnswers()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml", {})),
        camera_(scene_.cameras.front()) {
    Observer(*camera_.rig).observe(camera_.read_depth(3), camera_.at_exposure[3], frame_);
  }

  OpenScene scene_;
  const OpenCamera& camera_;
  Frame frame_;
};

TEST_F(VisibilityOfAnswers, TheJointsOfTheExposureGiveTheSharesOfTheExposure) {
  Asker asker(*camera_.rig);
  const auto at_exposure = shares_of(asker.ask(frame_));
  ASSERT_EQ(at_exposure.size(), 8U * 10);
  const auto later = shares_of(asker.ask(frame_, camera_.at_exposure[20]));
  EXPECT_NE(later, at_exposure);
  EXPECT_EQ(shares_of(asker.ask(frame_, camera_.at_exposure[3])), at_exposure);
}

TEST_F(VisibilityOfAnswers, LinksAreInTheOrderOfTheirIdsAndSeenInPart) {
  Asker asker(*camera_.rig);
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
  EvaluationArguments arguments;
  arguments.visibility = false;
  const OpenScene off = open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml", arguments);
  Asker asker(*camera_.rig);
  Asker asker_off(*off.cameras.front().rig);
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
    Asker asker(*camera_.rig);
    for (int i = 0; i < 20; ++i) out = shares_of(asker.ask(frame_, camera_.at_exposure[8]));
  };
  std::thread other(ask, std::ref(shares[0]));
  ask(shares[1]);
  other.join();
  EXPECT_EQ(shares[0], shares[1]);
  EXPECT_FALSE(shares[0].empty());
}

}  // namespace
}  // namespace berth
