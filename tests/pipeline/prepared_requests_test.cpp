// What requests may ask of prepared frames, and what preparing refuses.
#include "tests/pipeline/prepared_scene.hpp"

namespace berth {
namespace {

TEST_F(PreparedScene, ManyThreadsAskOne) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames, &joints(3));
  std::vector<Result> expected;
  for (std::size_t of = 0; of < 6; ++of) {
    expected.push_back(cold(frames, {.frames = frames, .joints = joints(of)}));
  }
  std::array<std::vector<Result>, 4> found;
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < found.size(); ++t) {
      threads.emplace_back([&, t] {
        Query query(robot());
        for (std::size_t i = 0; i < 12; ++i) {
          found[t].push_back(query.ask({.frames = {space}, .joints = joints((i + t) % 6)}));
        }
      });
    }
  }
  for (std::size_t t = 0; t < found.size(); ++t) {
    for (std::size_t i = 0; i < 12; ++i) expect_same(found[t][i], expected[(i + t) % 6]);
  }
}

TEST_F(PreparedScene, LookAheadIsThatOfItsFrames) {
  const SharedFrames frames = observe_all(3);
  const std::vector<JointState> path = {joints(4), joints(6), joints(8)};
  Query query(robot());
  const LookAhead found = query.ask({.frames = {prepare(frames)}, .ahead = path}).ahead;
  ASSERT_EQ(found.poses.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Result expected = cold(frames, {.frames = frames, .joints = path[i]});
    for (std::size_t k = 0; k < expected.links.size(); ++k) {
      expect_same(found.poses[i][k].nearest, static_cast<const SpacePair&>(expected.links[k]));
    }
  }
}

TEST_F(PreparedScene, VisibilityAndWhatWasRejectedAreThoseOfItsFrames) {
  EvaluationSettings settings = robot()->settings();
  settings.visibility = true;
  const auto mounted = testing::mounted_with(*scene_.cameras[0].mounted, settings,
                                             scene_.cameras[0].mounted->settings());
  SharedFrames frames(1);
  int rejected = 0;
  Query query(mounted->robot()), plain(mounted->robot());
  for (const std::size_t i : {3, 17, 30}) {
    const auto frame = std::make_shared<Frame>();
    DepthImage depth_m = scene_.cameras[0].read_depth(i);
    Observer(mounted).observe(depth_m, joints(i), *frame);
    draw_flying_pixels(frame->robot, depth_m, 6);
    Observer(mounted).observe(depth_m, joints(i), *frame);
    frames[0] = frame;
    auto space = std::make_shared<PreparedSpace>(mounted->robot(), 1);
    space->prepare(frames, nullptr);
    const Result& result = query.ask({.frames = {space}, .joints = joints(i + 1)});
    const Result& expected = plain.ask({.frames = frames, .joints = joints(i + 1)});
    expect_same(result, expected);
    for (std::size_t k = 0; k < result.links.size(); ++k) {
      const LinkVisibility& a = result.links[k].visibility;
      const LinkVisibility& b = expected.links[k].visibility;
      EXPECT_EQ(a.surface.seen, b.surface.seen);
      ASSERT_EQ(std::isnan(a.rejected_distance_m), std::isnan(b.rejected_distance_m));
      if (std::isnan(a.rejected_distance_m)) continue;
      ++rejected;
      EXPECT_NEAR(a.rejected_distance_m, b.rejected_distance_m, kDefaultTolerance_m);
    }
  }
  EXPECT_GT(rejected, 0);
}

TEST_F(PreparedScene, OneThatIsSearchedOnIsAskedAsBefore) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames);
  for (const std::size_t i : {4, 5, 9}) {
    space->search(joints(i));
    Query query(robot());
    expect_same(query.ask({.frames = {space}, .joints = joints(i + 1)}),
                cold(frames, {.frames = frames, .joints = joints(i + 1)}));
  }
  PreparedSpace(robot(), 3).search(joints(3));
}

TEST_F(PreparedScene, WithoutTimeARequestTellsWhatWasFoundBeforehand) {
  EvaluationSettings settings = robot()->settings();
  settings.distance.deadline_us = 0;
  const auto mounted = testing::mounted_with(*cameras_[0], settings, CameraSettings{});
  const auto frame = std::make_shared<Frame>();
  Observer(mounted).observe(scene_.cameras[0].read_depth(3), joints(3), *frame);
  const auto space = std::make_shared<PreparedSpace>(mounted->robot(), 1);
  space->prepare(SharedFrames{frame}, &joints(3));
  Query query(mounted->robot()), plain(mounted->robot());
  const Result& result = query.ask({.frames = {space}, .joints = joints(3)});
  for (const LinkResult& link : result.links) {
    ASSERT_TRUE(link.is_known());
    EXPECT_LE(link.distance_m - link.lower_bound_m, kDefaultTolerance_m + kUndecidedByCubes_m);
  }
  double most_m = 0;
  for (const LinkResult& link : plain.ask({.frames = *frame, .joints = joints(3)}).links) {
    most_m = std::max(most_m, double{link.is_known() ? link.distance_m - link.lower_bound_m : 1});
  }
  EXPECT_GT(most_m, 0.01) << "a request of no time finds less by itself";
}

TEST_F(PreparedScene, WithoutJointsOrFramesThereIsSomethingToAskAllTheSame) {
  Query query(robot());
  const auto empty = std::make_shared<PreparedSpace>(robot(), 3);
  EXPECT_EQ(query.ask({.frames = {empty}}).time.status, TimeStatus::no_frame);
  EXPECT_EQ(query.ask({.frames = {empty}}).cameras.size(), 3U);
  empty->prepare(SharedFrames(3), &joints(0));
  EXPECT_EQ(query.ask({.frames = {empty}, .now_s = 1.0}).time.status, TimeStatus::no_frame);
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames, nullptr);
  expect_same(query.ask({.frames = {space}, .joints = joints(3)}),
              cold(frames, {.frames = frames, .joints = joints(3)}));
}

TEST_F(PreparedScene, WhatItRefusesItTellsAndItStaysAsItWas) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames);
  Query query(robot());
  JointState wrong = joints(3);
  wrong.position.pop_back();
  expect_parts(error_message<std::invalid_argument>([&] { space->prepare(frames, &wrong); }),
               {"6", "7"});
  expect_same(query.ask({.frames = {space}}), cold(frames, {.frames = frames}));
  const auto many = std::make_shared<PreparedSpace>(robot(), kMostCameras + 1);
  expect_parts(error_message<std::invalid_argument>([&] { query.ask({.frames = {many}}); }),
               {"9 cameras", "1 to 8"});
}

}  // namespace
}  // namespace berth
