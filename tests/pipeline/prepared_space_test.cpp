// Requests about frames that were made ready beforehand, beside those about the same frames.
#include "berth/pipeline/prepared_space.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/pipeline/flying_pixels.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/view_with.hpp"

namespace berth {
namespace {

using SharedFrames = std::vector<std::shared_ptr<const Frame>>;

constexpr float kDefaultTolerance_m = 0.00101F;
/// What cubes of 0.1 mm may leave undecided.
constexpr float kUndecidedByCubes_m = 0.0004F;

void expect_same(const SpacePair& a, const SpacePair& b) {
  ASSERT_EQ(a.is_known(), b.is_known());
  // A result that is withheld has none.
  ASSERT_EQ(std::isnan(a.lower_bound_m), std::isnan(b.lower_bound_m));
  if (std::isnan(a.lower_bound_m)) return;
  EXPECT_NEAR(a.lower_bound_m, b.lower_bound_m, kDefaultTolerance_m + kUndecidedByCubes_m);
  if (!a.is_known()) return;
  EXPECT_LE(a.lower_bound_m, b.distance_m);
  EXPECT_LE(b.lower_bound_m, a.distance_m);
  EXPECT_LE(a.distance_m - a.lower_bound_m, kDefaultTolerance_m + kUndecidedByCubes_m);
}

/// Both tell the same, but for what is within the tolerance.
void expect_same(const Result& a, const Result& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.time.status, b.time.status);
  EXPECT_EQ(std::isnan(a.stamp_s), std::isnan(b.stamp_s));
  if (!std::isnan(a.stamp_s)) {
    EXPECT_EQ(a.stamp_s, b.stamp_s);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t k = 0; k < a.cameras.size(); ++k) {
    SCOPED_TRACE(k);
    EXPECT_EQ(a.cameras[k].status, b.cameras[k].status);
    EXPECT_EQ(a.cameras[k].has_frame, b.cameras[k].has_frame);
    if (is_used(a.cameras[k].status)) {
      EXPECT_EQ(a.cameras[k].X_BC.matrix(), b.cameras[k].X_BC.matrix());
    }
  }
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    SCOPED_TRACE(a.links[i].link);
    EXPECT_EQ(a.links[i].status, b.links[i].status);
    expect_same(static_cast<const SpacePair&>(a.links[i]), b.links[i]);
    expect_same(a.links[i].occupied, b.links[i].occupied);
  }
}

/// The bundled scene's three cameras.
class PreparedScene : public ::testing::Test {
 protected:
  PreparedScene() : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    const CameraSettings plain;
    for (const OpenCamera& camera : scene_.cameras) {
      views_.push_back(testing::view_with(*camera.view, plain));
    }
  }

  const std::shared_ptr<const Robot>& robot() const { return scene_.robot; }
  const JointState& joints(std::size_t i) const { return scene_.cameras[0].at_exposure[i]; }

  std::shared_ptr<Frame> observe(std::size_t k, std::size_t i, const PlaceAtExposure& place = {},
                                 FrameUse use = FrameUse::any_query) const {
    auto frame = std::make_shared<Frame>();
    const OpenCamera& camera = scene_.cameras[k];
    Observer(views_[k], {}, use)
        .observe(camera.read_depth(i), camera.at_exposure[i], *frame, {}, place);
    return frame;
  }
  /// The first camera's frame i, and the others' first ones after that.
  SharedFrames observe_all(std::size_t i, const PlaceAtExposure& place = {}) const {
    SharedFrames frames;
    for (std::size_t k = 0; k < views_.size(); ++k)
      frames.push_back(observe(k, after(k, i), place));
    return frames;
  }
  std::size_t after(std::size_t k, std::size_t i) const {
    const auto& stamps_s = scene_.cameras[k].source.stamps_s;
    return std::ranges::lower_bound(stamps_s, scene_.cameras[0].source.stamps_s[i]) -
           stamps_s.begin();
  }
  std::shared_ptr<PreparedSpace> prepare(const SharedFrames& frames,
                                         const JointState* joints = nullptr) const {
    auto space = std::make_shared<PreparedSpace>(robot(), frames.size());
    space->prepare(frames, joints);
    return space;
  }
  /// A request about frames alone, with nothing known before.
  Result cold(const SharedFrames& frames, Request request) const {
    request.frames = frames;
    return Query(robot()).ask(request);
  }

  OpenScene scene_;
  std::vector<std::shared_ptr<const MountedCamera>> views_;
};

TEST_F(PreparedScene, ARequestIsThatAboutItsFrames) {
  Query query(robot());
  for (const std::size_t i : {0, 3, 17}) {
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
    const Camera& camera = views_[k]->camera();
    Observer(views_[k]).observe(DepthImage(camera.width_px, camera.height_px, 0.3F),
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
  Observer(views_[0]).observe(DepthImage(640, 480, kNoDepth), joints(3), *blind);
  const auto moved = observe(0, 3);
  moved->watch.has_moved = true;
  const auto skewed = std::make_shared<Frame>();
  FrameTime time;
  time.status = TimeStatus::skewed;
  Observer(views_[0]).observe(scene_.cameras[0].read_depth(3), joints(3), *skewed, time);
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
  const auto view =
      testing::view_with(*scene_.cameras[0].view, settings, scene_.cameras[0].view->settings());
  SharedFrames frames(1);
  int rejected = 0;
  Query query(view->robot()), plain(view->robot());
  for (const std::size_t i : {3, 17, 30}) {
    const auto frame = std::make_shared<Frame>();
    DepthImage depth_m = scene_.cameras[0].read_depth(i);
    Observer(view).observe(depth_m, joints(i), *frame);
    draw_flying_pixels(frame->robot, depth_m);
    Observer(view).observe(depth_m, joints(i), *frame);
    frames[0] = frame;
    auto space = std::make_shared<PreparedSpace>(view->robot(), 1);
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
  const auto view = testing::view_with(*views_[0], settings, CameraSettings{});
  const auto frame = std::make_shared<Frame>();
  Observer(view).observe(scene_.cameras[0].read_depth(3), joints(3), *frame);
  const auto space = std::make_shared<PreparedSpace>(view->robot(), 1);
  space->prepare(SharedFrames{frame}, &joints(3));
  Query query(view->robot()), plain(view->robot());
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
  SharedFrames with_image = frames;
  with_image[1] = observe(1, 4, {}, FrameUse::image_query);
  expect_parts(error_message<std::invalid_argument>([&] { space->prepare(with_image, nullptr); }),
               {"left", "images", "any query"});
  EXPECT_EQ(space->frames()[1], frames[1]);
  Query query(robot());
  expect_same(query.ask({.frames = {space}}), cold(frames, {.frames = frames}));
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
