// Streams of requests about a robot that moves, stops, jumps and takes something up, while cameras
// come and go: each answer beside that of a cold request. BERTH_STREAMS=full in the environment
// makes it a hundred thousand requests.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string_view>

#include "sim/random.hpp"
#include "tests/distance/agreement.hpp"
#include "tests/support/mesh_world.hpp"
#include "tests/support/thinned.hpp"

namespace berth::testing {
namespace {

constexpr int kRequestsOfAStream = 250;
/// What cubes of 0.1 mm leave undecided at a finer tolerance: their diagonal, twice.
constexpr double kUndecided_m = 0.0004;
constexpr double kRounding_m = 5e-6;

int streams() {
  const char* set = std::getenv("BERTH_STREAMS");
  return set != nullptr && std::string_view(set) == "full" ? 400 : thinned(12);
}

struct Tally {
  int requests = 0;
  int pairs = 0;
  int known = 0;
  int wide = 0;
  int cold_wide = 0;
};

/// Two robots of three loose links and one of four, and what two cameras saw of the room of each.
struct StreamWorld {
  std::vector<MeshWorld> worlds;
  std::vector<std::shared_ptr<const RobotPatches>> robots;
  std::vector<CameraSpace> spaces;
  std::vector<Pose> X_BC;

  explicit StreamWorld(std::uint32_t seed) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      MeshWorldSettings settings;
      settings.links = i == 2 ? 4 : 3;
      worlds.push_back(draw_mesh_world(settings, 10 * seed + i));
    }
    spaces.resize(6);
    for (const MeshWorld& world : worlds) {
      robots.push_back(build_robot_patches(world.model));
      for (const MeshWorldView& view : world.views) {
        build_camera_space(view.camera, view.sensor_depth_m, view.obstacles, view.environment(),
                           world.settings, spaces[X_BC.size()]);
        X_BC.push_back(view.X_BC);
      }
    }
  }
};

class Stream {
 public:
  explicit Stream(std::uint32_t seed) : random_(seed), world_(seed) {
    take_robot(0);
    see_anew();
  }

  void run(Tally& tally) {
    for (int i = 0; i < kRequestsOfAStream; ++i) {
      SCOPED_TRACE(fmt::format("request {}", i));
      change();
      const MeshRequest request = draw_request();
      ask(request, workspace_, answer_);
      compare(request, tally);
      if (::testing::Test::HasFailure()) return;
    }
  }

 private:
  enum class Gait { fine, coarse, turning, standing };

  void take_robot(int robot) {
    robot_ = robot;
    pose_ = home_ = world_.worlds[robot].pose;
  }

  /// Some of the cameras, of other ages, into one space of two.
  void see_anew() {
    std::vector<PosedSpace> posed;
    for (std::size_t k = 0; k < world_.spaces.size(); ++k) {
      if (!random_.chance(0.4)) continue;
      const double blind_s = std::numeric_limits<double>::infinity();
      double age_s = random_.chance(0.4) ? 0 : 0.01 * random_.whole(0, 6);
      if (random_.chance(0.1)) age_s = random_.chance(0.5) ? blind_s : 0.25;
      posed.push_back({&world_.spaces[k], world_.X_BC[k], age_s});
    }
    // Memory that is taken from the other one stays there until this one is assigned anew.
    const bool takes_aged = random_.chance(0.5) && !is_taken_from_;
    if (!is_taken_from_) current_ = 1 - current_;
    UnknownSpace& other = spaces_[1 - current_];
    spaces_[current_].assign(posed, takes_aged ? &other : nullptr);
    is_taken_from_ = takes_aged;
  }

  Pose draw_motion() {
    const Eigen::Vector3d axis = sim::draw_point(random_, 1).normalized();
    double reach_m = 0, turn = 0;
    switch (gait_) {
      case Gait::standing:
        return Pose::Identity();
      case Gait::turning:
        turn = random_(0, 0.01);
        break;
      case Gait::fine:
        reach_m = 0.0003;
        turn = 0.001;
        break;
      case Gait::coarse:
        reach_m = 0.01;
        turn = 0.05;
        break;
    }
    return Eigen::Translation3d(sim::draw_point(random_, reach_m)) *
           Eigen::AngleAxisd(random_(-turn, turn), axis);
  }

  void move() {
    if (random_.chance(0.03)) gait_ = static_cast<Gait>(random_.whole(0, 3));
    if (random_.chance(0.01)) pose_ = home_;
    if (random_.chance(0.01)) {
      for (Pose& X_BL : pose_.X_BL) X_BL.translation() += sim::draw_point(random_, 0.3);
    }
    for (Pose& X_BL : pose_.X_BL) {
      if (random_.chance(0.8)) X_BL = X_BL * draw_motion();
    }
  }

  void change() {
    move();
    if (random_.chance(0.03)) take_robot(random_.whole(0, 2));
    if (random_.chance(0.05)) see_anew();
    if (random_.chance(0.01)) workspace_.forget();
    if (random_.chance(0.05)) answer_.clear();
    if (random_.chance(0.03)) {
      MeshWorkspace prepared;
      std::vector<WholeLinkDistance> first;
      ask(draw_request(), prepared, first);
      move();
      workspace_ = prepared;
      answer_ = first;
    }
  }

  MeshRequest draw_request() {
    if (random_.chance(0.03)) {
      constexpr double kTolerances_m[] = {0.001, 0.001, 0.0003, 0.0001, 0.00002, 0, 0.01};
      tolerance_m_ = kTolerances_m[random_.whole(0, 6)];
    }
    if (random_.chance(0.03)) range_m_ = random_.chance(0.5) ? 1 : random_(0.1, 2);
    MeshRequest request{.range_m = range_m_, .tolerance_m = tolerance_m_};
    if (random_.chance(0.1)) request.range_m = random_(0.02, 2);
    if (random_.chance(0.05)) request.unknown = false;
    if (random_.chance(0.3)) request.deadline_us = random_.chance(0.5) ? 0 : random_(0, 100);
    return request;
  }

  void ask(const MeshRequest& request, MeshWorkspace& workspace,
           std::vector<WholeLinkDistance>& answer) const {
    mesh_distances(*world_.robots[robot_], pose_, spaces_[current_], request, workspace, answer);
  }

  void compare(MeshRequest request, Tally& tally) const {
    const bool is_whole = !request.deadline_us;
    request.deadline_us.reset();
    MeshWorkspace none;
    std::vector<WholeLinkDistance> cold;
    ask(request, none, cold);
    SCOPED_TRACE(fmt::format("range {} m, tolerance {} m, {}, {}", request.range_m,
                             request.tolerance_m, request.unknown ? "unknown" : "occupied alone",
                             is_whole ? "to the end" : "cut short"));
    expect_agree(answer_, cold);
    ASSERT_EQ(answer_.size(), cold.size());
    ++tally.requests;
    for (std::size_t i = 0; i < answer_.size(); ++i) {
      const WholeLinkDistance& link = answer_[i];
      for (const auto& pair : {&WholeLinkDistance::nearest, &WholeLinkDistance::occupied}) {
        judge(link.*pair, request);
        if (!is_whole) continue;
        ++tally.pairs;
        tally.known += (link.*pair).is_known();
        tally.wide += is_wide(link.*pair, request);
        tally.cold_wide += is_wide(cold[i].*pair, request);
      }
      EXPECT_FALSE(link.occupied.distance_m < link.nearest.distance_m);
    }
  }

  /// What an answer says of itself.
  void judge(const SpacePair& pair, const MeshRequest& request) const {
    EXPECT_GE(pair.lower_bound_m, 0);
    EXPECT_LE(pair.lower_bound_m, static_cast<float>(request.range_m));
    if (!pair.is_known()) return;
    EXPECT_LE(pair.lower_bound_m, pair.distance_m);
    EXPECT_NEAR((pair.robot_point_B_m - pair.obstacle_point_B_m).norm(), pair.distance_m, 1e-6);
    EXPECT_LT(pair.camera, static_cast<int>(spaces_[current_].views().size()));
  }

  /// Whether its bounds are not as near together as the tolerance says: space may be undecided down
  /// to the smallest cubes.
  static bool is_wide(const SpacePair& pair, const MeshRequest& request) {
    const double gap_m =
        (pair.is_known() ? pair.distance_m : request.range_m) - double{pair.lower_bound_m};
    const bool may_be_undecided =
        pair.is_known() && pair.obstacle_is == ObstacleKind::unknown && request.tolerance_m < 0.001;
    return gap_m > std::max(request.tolerance_m, 20e-6) + kRounding_m +
                       (may_be_undecided ? kUndecided_m : 0);
  }

  sim::Random random_;
  StreamWorld world_;
  int robot_ = 0;
  RobotPose home_;
  RobotPose pose_;
  Gait gait_ = Gait::fine;
  double tolerance_m_ = 0.001;
  double range_m_ = 1;
  UnknownSpace spaces_[2];
  int current_ = 0;
  /// Whether the current space has aged images of the other one.
  bool is_taken_from_ = false;
  MeshWorkspace workspace_;
  std::vector<WholeLinkDistance> answer_;
};

TEST(Stream, EachAnswerAgreesWithThatOfAColdRequest) {
  Tally tally;
  const int count = streams();
  for (int seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(fmt::format("stream {}", seed));
    Stream(static_cast<std::uint32_t>(seed)).run(tally);
    if (HasFailure()) break;
  }
  RecordProperty("requests", tally.requests);
  RecordProperty("wide", tally.wide);
  fmt::print("{} requests, {} pairs to the end, {} within the range; wide: {}, of cold ones {}\n",
             tally.requests, tally.pairs, tally.known, tally.wide, tally.cold_wide);
  EXPECT_GT(tally.known, tally.pairs / 2);
  // Going on from the request before leaves no more of them.
  EXPECT_LE(tally.wide, tally.cold_wide + tally.pairs / 1000);
}

}  // namespace
}  // namespace berth::testing
