// The method `mesh` against its slow twin, link by link: a sample of links and requests.
// BERTH_MESH_TWIN=full in the environment makes it ten thousand links, and every request.
#include "berth/distance/mesh_distances.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "mesh_case.hpp"
#include "sim/odd_views.hpp"
#include "sim/whole_robot_twin.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/thinned.hpp"

namespace berth::sim {
namespace {

/// What floats may lose: positions of a few metres in single precision, added up.
constexpr double kRounding_m = 5e-6;

/// What cubes of 0.1 mm leave undecided at a finer tolerance: their diagonal, twice.
constexpr double kUndecided_m = 0.0004;

/// Finer than for a look: the finest tolerance that is asked for.
constexpr TwinSettings kTwin{.gap_m = 0.0002, .least_edge_m = 5e-5};

struct NamedRobot {
  std::string name;
  RobotModel model;
  std::vector<MeshTree> trees;
};

NamedRobot make_robot(const std::string& name, const RobotSettings& settings) {
  RobotModel model = load_robot(settings);
  std::vector<MeshTree> trees = build_link_trees(model);
  return {name, std::move(model), std::move(trees)};
}

NamedRobot bundled_arm() {
  return make_robot("bundled arm", {.urdf = BERTH_BUNDLED_ARM "/arm.urdf",
                                    .package_paths = {{"berth_arm", BERTH_BUNDLED_ARM}},
                                    .environment_links = {"table"}});
}

/// An answer and what it says of itself, as the twin sees it.
class Judge {
 public:
  Judge(const RobotModel& model, const RobotPose& pose, const PointSpace& space)
      : model_(model),
        pose_(pose),
        space_(space),
        twin_(twin_distances(model, pose, space, kTwin)) {
    for (const std::size_t link : model.evaluated_links) {
      meshes_L_.emplace_back(model.links[link].mesh_L);
    }
  }

  std::size_t links() const { return twin_.size(); }

  /// Without a deadline the answer has to be as near as the tolerance says; how many are not is
  /// counted, because space may be undecided down to the smallest cubes.
  void judge(const std::vector<WholeLinkDistance>& answers, const MeshRequest& request) {
    ASSERT_EQ(answers.size(), twin_.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      SCOPED_TRACE(fmt::format("link {}, tolerance {} m", i + 1, request.tolerance_m));
      EXPECT_EQ(answers[i].id, i + 1);
      const auto& wanted = request.unknown ? twin_[i].nearest : twin_[i].reading;
      {
        SCOPED_TRACE("nearest");
        judge_pair(answers[i].nearest, wanted, i, request);
      }
      SCOPED_TRACE("reading");
      judge_pair(answers[i].occupied, twin_[i].reading, i, request);
      EXPECT_FALSE(answers[i].occupied.is_known() &&
                   answers[i].occupied.obstacle_is != ObstacleKind::occupied);
      EXPECT_FALSE(answers[i].occupied.distance_m < answers[i].nearest.distance_m);
    }
  }

  int pairs = 0;
  int wide = 0;

 private:
  void judge_pair(const SpacePair& pair, const TwinInterval& twin, std::size_t link,
                  const MeshRequest& request) {
    const double range_m = request.range_m;
    SCOPED_TRACE(fmt::format("lower {} m, distance {} m; twin [{}, {}] m", pair.lower_bound_m,
                             pair.distance_m, twin.lower_m, twin.upper_m));
    EXPECT_GE(pair.lower_bound_m, 0);
    EXPECT_LE(pair.lower_bound_m, range_m);
    EXPECT_LE(pair.lower_bound_m, twin.upper_m + kRounding_m) << "too far";
    if (pair.is_known()) {
      EXPECT_GE(pair.distance_m, twin.lower_m - kRounding_m) << "too near";
      EXPECT_LE(pair.distance_m, range_m);
      EXPECT_LE(pair.lower_bound_m, pair.distance_m);
      judge_points(pair, link);
    }
    if (request.deadline_us) return;
    ++pairs;
    if (pair.is_known()) {
      const double undecided_m =
          pair.obstacle_is != ObstacleKind::occupied && request.tolerance_m < 0.001 ? kUndecided_m
                                                                                    : 0;
      const double tolerance_m = std::max(request.tolerance_m, 20e-6) + kRounding_m + undecided_m;
      wide += pair.distance_m - pair.lower_bound_m > tolerance_m;
    } else {
      EXPECT_GE(twin.upper_m, range_m - request.tolerance_m) << "not found";
      wide += pair.lower_bound_m < range_m;
    }
  }

  void judge_points(const SpacePair& pair, std::size_t i) const {
    const Eigen::Vector3d robot_B = pair.robot_point_B_m.cast<double>();
    const Eigen::Vector3d obstacle_B = pair.obstacle_point_B_m.cast<double>();
    EXPECT_NEAR((robot_B - obstacle_B).norm(), pair.distance_m, kRounding_m);
    const std::size_t link = model_.evaluated_links[i];
    EXPECT_LE(meshes_L_[i](pose_.X_BL[link].inverse() * robot_B).distance_m, kRounding_m);
    ASSERT_LT(pair.camera, static_cast<int>(space_.views().size()));
    if (pair.obstacle_is == ObstacleKind::unobserved) {
      EXPECT_EQ(pair.obstacle_pixel, Pixel{});
      EXPECT_TRUE(holds_beside(obstacle_B, [&](const Eigen::Vector3d& p_B) {
        return space_.is_unobserved(p_B);
      })) << "in an image";
      return;
    }
    EXPECT_TRUE(is_in_pixel(pair, obstacle_B)) << "not in its pixel";
    if (pair.obstacle_is == ObstacleKind::occupied) {
      EXPECT_TRUE(is_in_depths(pair, obstacle_B, 0, space_.settings().surface_thickness_m))
          << "not in its surface layer";
    } else {
      const double hides_m =
          space_.hidden_from_m(pair.camera)(pair.obstacle_pixel.u, pair.obstacle_pixel.v);
      EXPECT_GE(project(pair.camera, obstacle_B).z_m, hides_m - kRounding_m) << "not hidden";
      for (std::size_t j = 0; j < space_.views().size(); ++j) {
        if (static_cast<int>(j) == pair.camera) continue;
        EXPECT_FALSE(is_surely_free(j, obstacle_B)) << "seen free by view " << j;
      }
    }
  }

  /// Where p_B is in a view's image, in pixels, and by how many it may be wrong.
  struct Projection {
    double u, v, z_m, slack_px;
  };
  Projection project(std::size_t k, const Eigen::Vector3d& p_B) const {
    const PointView& view = space_.views()[k];
    const Eigen::Vector3d p_C = view.X_BC.inverse() * p_B;
    const Camera& camera = view.camera;
    return {camera.fx_px * p_C.x() / p_C.z() + camera.cx_px,
            camera.fy_px * p_C.y() / p_C.z() + camera.cy_px, p_C.z(),
            std::max(camera.fx_px, camera.fy_px) * 2 * kRounding_m / p_C.z()};
  }

  bool is_in_pixel(const SpacePair& pair, const Eigen::Vector3d& p_B) const {
    const Projection at = project(pair.camera, p_B);
    return std::abs(at.u - pair.obstacle_pixel.u) <= 0.5 + at.slack_px &&
           std::abs(at.v - pair.obstacle_pixel.v) <= 0.5 + at.slack_px;
  }

  /// Whether it lies between these two depths behind the reading of its pixel.
  bool is_in_depths(const SpacePair& pair, const Eigen::Vector3d& p_B, double from_m,
                    double to_m) const {
    const double front_m =
        space_.views()[pair.camera].obstacle_depth_m(pair.obstacle_pixel.u, pair.obstacle_pixel.v);
    const double behind_m = project(pair.camera, p_B).z_m - front_m;
    return behind_m >= from_m - kRounding_m && behind_m <= to_m + kRounding_m;
  }

  /// Of a point next to p_B.
  template <class Predicate>
  static bool holds_beside(const Eigen::Vector3d& p_B, Predicate predicate) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      if (predicate(p_B + kRounding_m * sign)) return true;
    }
    return false;
  }

  /// Whether all that is next to p_B is seen free.
  bool is_surely_free(std::size_t j, const Eigen::Vector3d& p_B) const {
    return !holds_beside(p_B, [&](const Eigen::Vector3d& p) { return !space_.is_free(j, p); });
  }

  const RobotModel& model_;
  const RobotPose& pose_;
  const PointSpace& space_;
  const std::vector<TwinDistance> twin_;
  std::vector<NearestOnMesh> meshes_L_;
};

/// The method `mesh`, set up for one case.
class Asked {
 public:
  Asked(const RobotModel& model, const MeshCase& mesh_case)
      : patches_(build_robot_patches(model)), pose_(mesh_case.pose) {
    spaces_.resize(mesh_case.views.size());
    std::vector<PosedSpace> posed;
    for (std::size_t k = 0; k < spaces_.size(); ++k) {
      const DrawnView& view = mesh_case.views[k];
      build_camera_space(view.camera, view.depth_m, view.obstacles, {}, mesh_case.settings,
                         spaces_[k]);
      posed.push_back({&spaces_[k], view.X_BC, view.age_s});
    }
    hidden_.assign(posed);
  }

  /// Cold: nothing is known of an answer before.
  std::vector<WholeLinkDistance> ask(const MeshRequest& request) {
    std::vector<WholeLinkDistance> answers;
    workspace_ = {};
    ask_again(request, answers);
    return answers;
  }
  void ask_again(const MeshRequest& request, std::vector<WholeLinkDistance>& answers) {
    mesh_distances(*patches_, pose_, hidden_, request, workspace_, answers);
  }

 private:
  std::shared_ptr<const RobotPatches> patches_;
  const RobotPose& pose_;
  std::vector<CameraSpace> spaces_;
  UnknownSpace hidden_;
  MeshWorkspace workspace_;
};

struct Tally {
  int links = 0;
  int pairs = 0;
  int wide = 0;
};

bool is_full() {
  const char* set = std::getenv("BERTH_MESH_TWIN");
  return set != nullptr && std::string_view(set) == "full";
}

/// Each asked cold, and again from the answer to it.
std::vector<double> tolerances_m() {
  return is_full() ? std::vector{0.0001, 0.001, 0.01} : std::vector{0.0001, 0.01};
}

std::vector<double> deadlines_us() {
  return is_full() ? std::vector<double>{0, 20, 200, 2000} : std::vector<double>{0, 200};
}

void judge_case(const RobotModel& model, const MeshCase& mesh_case, Tally& tally) {
  const PointSpace space = point_space(mesh_case.views, mesh_case.settings);
  Judge judge(model, mesh_case.pose, space);
  Asked asked(model, mesh_case);
  for (const double tolerance_m : tolerances_m()) {
    const MeshRequest request{.tolerance_m = tolerance_m};
    std::vector<WholeLinkDistance> answers = asked.ask(request);
    judge.judge(answers, request);
    asked.ask_again(request, answers);
    judge.judge(answers, request);
  }
  const MeshRequest seen_alone{.unknown = false};
  judge.judge(asked.ask(seen_alone), seen_alone);
  for (const double deadline_us : deadlines_us()) {
    const MeshRequest request{.tolerance_m = 0.0001, .deadline_us = deadline_us};
    Asked cold(model, mesh_case);
    judge.judge(cold.ask(request), request);
  }
  tally.links += static_cast<int>(judge.links());
  tally.pairs += judge.pairs;
  tally.wide += judge.wide;
}

/// Cases from seed 0 on.
void judge_random_cases(const NamedRobot& robot, int least_links) {
  Tally tally;
  for (std::uint32_t seed = 0; tally.links < least_links; ++seed) {
    SCOPED_TRACE(fmt::format("{}, seed {}", robot.name, seed));
    judge_case(robot.model, draw_mesh_case(robot.model, robot.trees, seed), tally);
  }
  // So few pairs may stay farther apart than the tolerance.
  EXPECT_LE(tally.wide, tally.pairs / 100);
  ::testing::Test::RecordProperty("links", tally.links);
  ::testing::Test::RecordProperty("wide", tally.wide);
}

TEST(MeshDistances, OfTheBundledArmLieInTheTwinsIntervals) {
  judge_random_cases(bundled_arm(), is_full() ? 5000 : thinned(40));
}

TEST(MeshDistances, OfRealRobotsLieInTheTwinsIntervals) {
  const std::filesystem::path folder = data_folder() / "robots";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no robots in " << folder;
  for (const char* urdf : {"xarm7/xarm7_with_gripper", "widowx/widowx", "kuka_lbr_med7/lbr_med7",
                           "franka_panda/panda"}) {
    judge_random_cases(make_robot(urdf, {.urdf = folder / fmt::format("{}.urdf", urdf)}),
                       is_full() ? 1250 : 1);
  }
}

TEST(MeshDistances, OfOddScenesLieInTheTwinsIntervals) {
  const NamedRobot robot = bundled_arm();
  Tally tally;
  for (const NamedViews& odd : odd_views(robot.model, robot.trees, 3)) {
    SCOPED_TRACE(odd.name);
    judge_case(robot.model, plain_mesh_case(odd.drawn), tally);
  }
  EXPECT_GT(tally.links, 50);
}

}  // namespace
}  // namespace berth::sim
