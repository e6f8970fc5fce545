// Requests about frames that were made ready beforehand, beside those about the same frames.
#include "tests/pipeline/prepared_scene.hpp"

namespace berth {
namespace {

TEST_F(PreparedScene, ARequestIsThatAboutItsFrames) {
  Query query(robot());
  // Not 0: there the borders of two cameras' pixels and of free depth meet along an edge, and cubes
  // of 0.1 mm leave 2.5 mm of it undecided.
  for (const std::size_t i : {1, 3, 17}) {
    const SharedFrames frames = observe_all(i);
    const auto space = prepare(frames, &joints(i));
    const std::uint64_t assembled = query.frames().space().serial_number();
    for (std::size_t of = i; of < i + 4; ++of) {
      SCOPED_TRACE("frames " + std::to_string(i) + ", joints " + std::to_string(of));
      const Result& result = query.ask({.frames = {space}, .joints = joints(of)});
      EXPECT_EQ(result.status, ResultStatus::ok);
      expect_same(result, cold(frames, {.frames = frames, .joints = joints(of)}));
    }
    EXPECT_NE(query.frames().space().serial_number(), assembled);
    expect_same(query.ask({.frames = {space}}), cold(frames, {.frames = frames}));
  }
}

TEST_F(PreparedScene, NothingIsAssembledByARequest) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames);
  Query first(robot()), second(robot());
  first.ask({.frames = {space}});
  const FrameSet* const set = &first.frames();
  const double newest_s = frames[2]->stamp_s;
  for (const double wait_s : {0.0, 0.001, 0.03}) {
    second.ask({.frames = {space}, .now_s = newest_s + wait_s});
    EXPECT_EQ(&second.frames(), set) << "both ask what was prepared";
  }
}

TEST_F(PreparedScene, ACameraThatIsLostAfterwardsIsNotUsed) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames);
  const double max_age_s = robot()->settings().time.max_frame_age_s;
  Query query(robot());
  // The cameras' exposures lie apart, so that they are lost one after the other.
  int lost = 0;
  for (const auto& oldest : frames) {
    const double now_s = oldest->stamp_s + max_age_s + 0.001;
    ++lost;
    SCOPED_TRACE(lost);
    const JointState& asked = joints(5);
    JointState now = asked;
    now.stamp_s = now_s;
    const Result& result = query.ask({.frames = {space}, .joints = now, .now_s = now_s});
    expect_same(result, cold(frames, {.frames = frames, .joints = now, .now_s = now_s}));
    EXPECT_EQ(std::ranges::count(result.cameras, CameraStatus::too_old, &CameraState::status),
              lost);
    EXPECT_EQ(result.status, lost == 3 ? ResultStatus::stale : ResultStatus::degraded);
    for (const LinkResult& link : result.links) {
      if (link.is_known()) {
        EXPECT_EQ(result.cameras[link.camera].status, CameraStatus::ok);
      }
      if (link.occupied.is_known()) {
        EXPECT_EQ(result.cameras[link.occupied.camera].status, CameraStatus::ok);
      }
    }
  }
  const double back_s = frames[2]->stamp_s;
  EXPECT_EQ(query.ask({.frames = {space}, .now_s = back_s}).status, ResultStatus::ok);
  expect_same(query.ask({.frames = {space}, .now_s = back_s}),
              cold(frames, {.frames = frames, .now_s = back_s}));
}

TEST_F(PreparedScene, WhatALostCameraSawFreeIsUnknownAgain) {
  // Two cameras behind plates know nothing; all that is known to be free is of the third one.
  SharedFrames frames = observe_all(3);
  for (const std::size_t k : {1, 2}) {
    auto covered = std::make_shared<Frame>();
    const Camera& camera = cameras_[k]->camera();
    Observer(cameras_[k])
        .observe(DepthImage(camera.width_px, camera.height_px, 0.3F),
                 scene_.cameras[k].at_exposure[after(k, 3)], *covered);
    frames[k] = covered;
  }
  const auto space = prepare(frames);
  const double now_s = frames[0]->stamp_s + robot()->settings().time.max_frame_age_s + 0.001;
  ASSERT_LT(now_s, frames[1]->stamp_s + robot()->settings().time.max_frame_age_s);
  Query query(robot());
  query.ask({.frames = {space}});
  const Result lost = query.ask({.frames = {space}, .now_s = now_s});
  expect_same(lost, cold(frames, {.frames = frames, .now_s = now_s}));
  for (const LinkResult& link : lost.links) EXPECT_LE(link.distance_m, kDefaultTolerance_m);
  EXPECT_EQ(lost.status, ResultStatus::degraded);
}

TEST_F(PreparedScene, AFrameInTheFutureIsNotUsedUntilItsTime) {
  SharedFrames frames = observe_all(3);
  const auto space = prepare(frames);
  const double now_s = frames[0]->stamp_s;
  Query query(robot());
  const Result& result = query.ask({.frames = {space}, .now_s = now_s});
  EXPECT_EQ(result.cameras[0].status, CameraStatus::ok);
  EXPECT_EQ(result.cameras[1].time, TimeStatus::frame_in_future);
  EXPECT_EQ(result.cameras[2].time, TimeStatus::frame_in_future);
  EXPECT_EQ(result.status, ResultStatus::degraded);
  expect_same(result, cold(frames, {.frames = frames, .now_s = now_s}));
}

TEST_F(PreparedScene, ACameraThatIsBlindMovedStaleOrMissingIsNamed) {
  const auto blind = std::make_shared<Frame>();
  Observer(cameras_[0]).observe(DepthImage(640, 480, kNoDepth), joints(3), *blind);
  const auto moved = observe(0, 3);
  moved->watch.has_moved = true;
  const auto skewed = std::make_shared<Frame>();
  FrameTime time;
  time.status = TimeStatus::skewed;
  Observer(cameras_[0]).observe(scene_.cameras[0].read_depth(3), joints(3), *skewed, time);
  const std::array<std::pair<std::shared_ptr<const Frame>, CameraStatus>, 4> cases = {
      {{blind, CameraStatus::blind},
       {moved, CameraStatus::moved},
       {skewed, CameraStatus::stale},
       {nullptr, CameraStatus::no_frame}}};
  Query query(robot());
  for (const auto& [first, status] : cases) {
    SCOPED_TRACE(name_of(status));
    const SharedFrames frames = {first, observe(1, after(1, 3)), observe(2, after(2, 3))};
    const Result& result = query.ask({.frames = {prepare(frames)}});
    EXPECT_EQ(result.cameras[0].status, status);
    EXPECT_EQ(result.status, ResultStatus::degraded);
    expect_same(result, cold(frames, {.frames = frames}));
  }
}

TEST_F(PreparedScene, TheRootMayStandElsewhereThanItWasPreparedFor) {
  PlaceAtExposure place;
  place.X_WB.translation() << 0.5, 0, 0;
  SharedFrames frames = observe_all(3, place);
  place.X_WB.translation() << 0.52, 0.01, 0;
  frames[2] = observe(2, after(2, 3), place);
  const auto space = prepare(frames);
  Query query(robot());
  Pose elsewhere = place.X_WB;
  elsewhere.translation().y() += 0.05;
  elsewhere.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d::UnitZ()));
  const Result here = query.ask({.frames = {space}});
  expect_same(here, cold(frames, {.frames = frames}));
  const FrameSet* const prepared_set = &query.frames();
  const Result there = query.ask({.frames = {space}, .X_WB = elsewhere});
  EXPECT_NE(&query.frames(), prepared_set);
  expect_same(there, cold(frames, {.frames = frames, .X_WB = elsewhere}));
  EXPECT_NE(here.links.back().distance_m, there.links.back().distance_m);
  expect_same(query.ask({.frames = {space}, .X_WB = place.X_WB}), here);
  EXPECT_EQ(&query.frames(), prepared_set);
  Pose unset = unset_pose();
  EXPECT_EQ(query.ask({.frames = {space}, .X_WB = unset}).time.status, TimeStatus::stale_pose);
  expect_same(query.ask({.frames = {space}}), here);
}

/// To the last bit, so that a recording can begin anywhere.
TEST_F(PreparedScene, AfterForgettingARequestGoesOnFromWhatWasPrepared) {
  const SharedFrames frames = observe_all(3);
  const auto space = prepare(frames, &joints(3));
  Query first(robot()), query(robot());
  const Result& expected = first.ask({.frames = {space}, .joints = joints(9)});
  for (const std::size_t of : {3, 20}) query.ask({.frames = {space}, .joints = joints(of)});
  query.forget();
  const Result& result = query.ask({.frames = {space}, .joints = joints(9)});
  for (std::size_t i = 0; i < result.links.size(); ++i) {
    SCOPED_TRACE(result.links[i].link);
    EXPECT_EQ(result.links[i].distance_m, expected.links[i].distance_m);
    EXPECT_EQ(result.links[i].lower_bound_m, expected.links[i].lower_bound_m);
  }
}

TEST_F(PreparedScene, OneThatIsPreparedAnewAtItsPlaceIsAskedAnew) {
  const SharedFrames before = observe_all(3), after = observe_all(17);
  const auto space = prepare(before);
  Query query(robot());
  const double late_s = before[0]->stamp_s + robot()->settings().time.max_frame_age_s + 0.001;
  for (const bool is_late : {false, true}) {
    for (int round = 0; round < 2; ++round) {
      for (const SharedFrames* frames : {&before, &after, &after}) {
        space->prepare(*frames, nullptr);
        Request request{.frames = {space}};
        if (is_late && frames == &before) request.now_s = late_s;
        expect_same(query.ask(request), cold(*frames, request));
        // Again, from what the first one found out.
        expect_same(query.ask(request), cold(*frames, request));
      }
    }
  }
}

TEST_F(PreparedScene, FramesAlonePreparedOrOthersFollowOneAnother) {
  const SharedFrames first = observe_all(3), second = observe_all(4);
  const auto of_first = prepare(first), of_second = prepare(second);
  Query query(robot());
  const Request requests[] = {{.frames = {of_first}},
                              {.frames = first},
                              {.frames = {of_second}},
                              {.frames = {of_first}},
                              {.frames = second}};
  const SharedFrames* const frames[] = {&first, &first, &second, &first, &second};
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    expect_same(query.ask(requests[i % 5]), cold(*frames[i % 5], {.frames = *frames[i % 5]}));
  }
}

}  // namespace
}  // namespace berth
