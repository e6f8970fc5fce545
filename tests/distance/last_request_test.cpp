// What a workspace remembers of the request before.
#include "berth/distance/last_request.hpp"

#include <gtest/gtest.h>

#include "sim/random.hpp"
#include "tests/distance/agreement.hpp"
#include "tests/support/mesh_world.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

Pose draw_motion(sim::Random& random, double reach_m) {
  const Eigen::Vector3d axis = sim::draw_point(random, 1).normalized();
  return Eigen::Translation3d(sim::draw_point(random, reach_m)) *
         Eigen::AngleAxisd(random(-5, 5) * reach_m, axis);
}

RobotPose moved(const RobotPose& pose, sim::Random& random, double reach_m) {
  RobotPose out = pose;
  for (Pose& X_BL : out.X_BL) X_BL = X_BL * draw_motion(random, reach_m);
  return out;
}

MeshWorld small_world(std::uint32_t seed) {
  MeshWorldSettings settings;
  settings.views = 1 + static_cast<int>(seed % 3);
  return draw_mesh_world(settings, 900 + seed);
}

/// One that asks again and again.
struct Requester {
  const PreparedWorld* world;
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> answer;

  const std::vector<WholeLinkDistance>& ask(const RobotPose& pose, const MeshRequest& request) {
    mesh_distances(world->patches(), pose, world->space(), request, workspace, answer);
    return answer;
  }
};

std::vector<WholeLinkDistance> ask_anew(const PreparedWorld& world, const RobotPose& pose,
                                        const MeshRequest& request) {
  return Requester{&world, {}, {}}.ask(pose, request);
}

TEST(LastRequest, NoPointOfALinkMovesByMore) {
  sim::Random random(3);
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const MeshWorld world = small_world(seed);
    const auto patches = build_robot_patches(world.model);
    for (const LinkPatches& link : patches->links) {
      const Pose before = draw_motion(random, 1);
      const Pose after = before * draw_motion(random, seed % 2 ? 0.001 : 0.5);
      double most_m = 0;
      for (const auto& p_L_m : world.model.links[link.link].mesh_L.vertices_m) {
        const Eigen::Vector3d p = p_L_m.cast<double>();
        most_m = std::max(most_m, (after * p - before * p).norm());
      }
      const float bound_m = mesh::moved_at_most_m(link, before, after);
      EXPECT_GE(bound_m, most_m);
      EXPECT_LE(bound_m, 4 * most_m + 2e-6);
    }
  }
}

TEST(LastRequest, BoundsHoldOnWhileTheRobotMoves) {
  sim::Random random(5);
  for (std::uint32_t seed = 0; seed < thinned(9u); ++seed) {
    const MeshWorld world = small_world(seed);
    const PreparedWorld prepared(world);
    Requester requester{&prepared, {}, {}};
    RobotPose pose = world.pose;
    for (int step = 0; step < 12; ++step) {
      MeshRequest request{.range_m = random(0.2, 1.5)};
      if (step % 3 != 0) request.deadline_us = random(0, 100);
      if (step % 4 == 2) request.unknown = false;
      SCOPED_TRACE("seed " + std::to_string(seed) + " step " + std::to_string(step));
      const auto found = requester.ask(pose, request);
      request.deadline_us.reset();
      expect_agree(found, ask_anew(prepared, pose, request));
      for (const WholeLinkDistance& link : found) {
        EXPECT_LE(link.occupied.lower_bound_m, static_cast<float>(request.range_m));
        EXPECT_LE(link.nearest.lower_bound_m, static_cast<float>(request.range_m));
      }
      pose = moved(pose, random, random(0, 0.01));
    }
  }
}

TEST(LastRequest, WithoutTimeAnAnswerIsKnownToAsMuchAsTheLinkMoved) {
  sim::Random random(7);
  for (std::uint32_t seed = 0; seed < thinned(9u); ++seed) {
    SCOPED_TRACE(seed);
    const MeshWorld world = small_world(seed);
    const PreparedWorld prepared(world);
    Requester requester{&prepared, {}, {}};
    const auto before = requester.ask(world.pose, {});
    const RobotPose pose = moved(world.pose, random, 0.002);
    const auto found = requester.ask(pose, {.deadline_us = 0});
    for (std::size_t i = 0; i < found.size(); ++i) {
      const LinkPatches& link = prepared.patches().links[i];
      const float moved_m =
          mesh::moved_at_most_m(link, world.pose.X_BL[link.link], pose.X_BL[link.link]);
      EXPECT_GE(found[i].occupied.lower_bound_m, before[i].occupied.lower_bound_m - moved_m - 1e-6);
      EXPECT_GE(found[i].nearest.lower_bound_m, before[i].nearest.lower_bound_m - moved_m - 1e-6);
      if (!before[i].nearest.is_known() || before[i].nearest.distance_m + moved_m > 1) continue;
      ASSERT_TRUE(found[i].nearest.is_known());
      EXPECT_LE(found[i].nearest.distance_m, before[i].nearest.distance_m + moved_m + 1e-5);
    }
  }
}

TEST(LastRequest, AskedAgainAnAnswerBecomesNoWorse) {
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    SCOPED_TRACE(seed);
    const MeshWorld world = small_world(seed);
    const PreparedWorld prepared(world);
    Requester requester{&prepared, {}, {}};
    const auto once = requester.ask(world.pose, {});
    const auto again = requester.ask(world.pose, {});
    requester.workspace.forget();
    requester.answer.clear();
    const auto anew = requester.ask(world.pose, {});
    for (std::size_t i = 0; i < once.size(); ++i) {
      EXPECT_EQ(anew[i].nearest.lower_bound_m, once[i].nearest.lower_bound_m);
      if (!once[i].nearest.is_known()) continue;
      EXPECT_EQ(anew[i].nearest.distance_m, once[i].nearest.distance_m);
      EXPECT_LE(again[i].nearest.distance_m, once[i].nearest.distance_m + 2.1e-5);
      EXPECT_GE(again[i].nearest.lower_bound_m, once[i].nearest.lower_bound_m - 2e-6);
    }
  }
}

TEST(LastRequest, AnotherSpaceOrRobotIsANewStart) {
  MeshWorkspace workspace;
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    SCOPED_TRACE(seed);
    const MeshWorld world = small_world(seed);
    const PreparedWorld prepared(world);
    Requester requester{&prepared, std::move(workspace), {}};
    expect_agree(requester.ask(world.pose, {.deadline_us = 0}), ask_anew(prepared, world.pose, {}));
    requester.ask(world.pose, {});
    workspace = std::move(requester.workspace);
  }
}

TEST(LastRequest, UnknownSpaceThatIsLeftOutOnceIsBegunAnew) {
  const MeshRequest readings{.unknown = false};
  sim::Random random(11);
  for (std::uint32_t seed = 0; seed < thinned(30u); ++seed) {
    SCOPED_TRACE(seed);
    const MeshWorld before = small_world(seed), after = small_world(seed + 1);
    const PreparedWorld prepared_before(before), prepared(after);
    const auto ask = [&](const PreparedWorld& seen, const RobotPose& pose,
                         const MeshRequest& request, Requester& requester) {
      mesh_distances(prepared.patches(), pose, seen.space(), request, requester.workspace,
                     requester.answer);
    };
    Requester other_space{&prepared, {}, {}}, forgotten{&prepared, {}, {}};
    ask(prepared_before, after.pose, {}, other_space);
    ask(prepared, after.pose, readings, other_space);
    ask(prepared, after.pose, {}, other_space);
    expect_agree(other_space.answer, ask_anew(prepared, after.pose, {}));
    ask(prepared, moved(after.pose, random, 0.3), {}, forgotten);
    forgotten.workspace.forget();
    ask(prepared, after.pose, readings, forgotten);
    ask(prepared, after.pose, {}, forgotten);
    expect_agree(forgotten.answer, ask_anew(prepared, after.pose, {}));
  }
}

TEST(LastRequest, OneThatIsStoppedCertifiesWhatItKnowsAndTheNextOneGoesOn) {
  std::stop_source source;
  source.request_stop();
  const std::stop_token stop = source.get_token();
  constexpr double kRange_m = 8;
  const MeshRequest stopped{.range_m = kRange_m, .tolerance_m = 1e-5, .stop = &stop};
  const MeshRequest whole{.range_m = kRange_m, .tolerance_m = 1e-5};
  int unfinished = 0;
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE(seed);
    const MeshWorld world = small_world(seed);
    const PreparedWorld prepared(world);
    Requester requester{&prepared, {}, {}};
    const std::vector<WholeLinkDistance> early = requester.ask(world.pose, stopped);
    const std::vector<WholeLinkDistance> cold = ask_anew(prepared, world.pose, whole);
    expect_agree(early, cold);
    for (std::size_t i = 0; i < early.size(); ++i) {
      unfinished += early[i].nearest.lower_bound_m < cold[i].nearest.lower_bound_m - 0.001F;
    }
    expect_agree(requester.ask(world.pose, whole), cold);
  }
  EXPECT_GT(unfinished, 0);
}

TEST(LastRequest, ASpaceThatBeginsAnewIsAnotherOne) {
  const MeshWorld near = small_world(2);
  const PreparedWorld prepared(near);
  CameraSpace far_space;
  const MeshWorldView& view = near.views[0];
  ObstacleImage nothing = view.obstacles;
  for (float& depth_m : nothing.depth_m.pixels()) depth_m = 20;
  for (PixelFate& fate : nothing.fate.pixels()) fate = PixelFate::obstacle;
  build_camera_space(view.camera, nothing.depth_m, nothing, {}, {}, far_space);
  UnknownSpace space;
  const PosedSpace far[] = {{&far_space, view.X_BC, 0}};
  space.assign(far);
  const std::uint64_t before = space.serial_number();
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> answer;
  const MeshRequest readings{.unknown = false};
  mesh_distances(prepared.patches(), near.pose, space, readings, workspace, answer);
  for (const auto& link : answer) EXPECT_EQ(link.occupied.lower_bound_m, 1);
  std::vector<PosedSpace> posed;
  for (const FreeingCamera& seen : prepared.space().views()) {
    posed.push_back({seen.space, seen.X_BC, 0});
  }
  space.assign(posed);
  EXPECT_NE(space.serial_number(), before);
  mesh_distances(prepared.patches(), near.pose, space, readings, workspace, answer);
  expect_agree(answer, ask_anew(prepared, near.pose, readings));
  int within_range = 0;
  for (const auto& link : answer) within_range += link.occupied.is_known();
  EXPECT_GT(within_range, 0);
}

}  // namespace
}  // namespace berth::testing
