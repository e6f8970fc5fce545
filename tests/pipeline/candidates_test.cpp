// Pairs of a link beside its nearest one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "berth/distance/link_eighths.hpp"
#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "sim/nearest_on_mesh.hpp"

namespace berth {
namespace {

constexpr float kApart_m = 0.05F;

double area_m2(const LinkPatches& link) {
  double sum_m2 = 0;
  for (int t = 0; t < link.triangle_count; ++t) {
    Eigen::Matrix3d corners_m;
    for (int k = 0; k < 9; ++k) corners_m(k % 3, k / 3) = link.corners_m[k][t];
    const Eigen::Vector3d a_m = corners_m.col(0);
    sum_m2 += (corners_m.col(1) - a_m).cross(corners_m.col(2) - a_m).norm() / 2;
  }
  return sum_m2;
}

/// The bundled scene's first images, by a robot with this number of pairs of each link.
class Candidates : public ::testing::Test {
 protected:
  explicit Candidates(int candidates = 4)
      : scene(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    EvaluationSettings settings;
    settings.candidates = candidates;
    robot = with_settings(scene.robot, settings);
    frames.resize(scene.cameras.size());
    for (std::size_t c = 0; c < frames.size(); ++c) {
      const OpenCamera& camera = scene.cameras[c];
      Observer(camera.mounted).observe(camera.read_depth(0), camera.at_exposure[0], frames[c]);
      newest.push_back(&frames[c]);
    }
  }

  OpenScene scene;
  std::shared_ptr<const Robot> robot;
  std::vector<Frame> frames;
  std::vector<const Frame*> newest;
};

TEST_F(Candidates, TheEighthsOfALinkAreAllOfIt) {
  const RobotPatches& eighths = robot->eighths();
  const RobotModel& model = robot->model();
  for (const LinkPatches& whole : robot->patches()->links) {
    if (!model.is_moved(whole.link)) continue;
    double sum_m2 = 0;
    std::vector<Eigen::AlignedBox3f> boxes_m;
    for (const LinkPatches& eighth : eighths.links) {
      if (eighth.link != whole.link) continue;
      sum_m2 += area_m2(eighth);
      Eigen::AlignedBox3f& box_m = boxes_m.emplace_back();
      for (int t = 0; t < eighth.triangle_count; ++t) {
        for (int k = 0; k < 9; k += 3) {
          box_m.extend(Eigen::Vector3f(eighth.corners_m[k][t], eighth.corners_m[k + 1][t],
                                       eighth.corners_m[k + 2][t]));
        }
      }
    }
    EXPECT_NEAR(sum_m2, area_m2(whole), 1e-4 * sum_m2);
    EXPECT_GE(boxes_m.size(), 2U);
    // Side by side: no two share more than a plane.
    for (std::size_t i = 0; i < boxes_m.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const Eigen::Vector3f shared_m = boxes_m[i].intersection(boxes_m[k]).sizes();
        EXPECT_LE(shared_m.minCoeff(), 1e-6F);
      }
    }
  }
}

TEST_F(Candidates, AreApartOnTheLinkAndNearestFirst) {
  Query query(robot);
  std::size_t count = 0;
  for (const std::size_t i : {0, 5, 10, 15, 20}) {
    const Result& result = query.ask({newest, scene.cameras[0].at_exposure[i]});
    ASSERT_TRUE(result.has_candidates);
    for (const LinkResult& link : result.links) {
      EXPECT_LE(link.candidates.size(), 3U);
      EXPECT_TRUE(link.is_moved || link.candidates.empty());
      const std::size_t index = robot->model().evaluated_links[link.id - 1];
      const sim::NearestOnMesh mesh_L(robot->model().links[index].mesh_L);
      const Pose X_LB = result.pose.X_BL[index].inverse();
      std::vector<SpacePair> before{link};
      for (const SpacePair& pair : link.candidates) {
        EXPECT_GE(pair.distance_m, link.distance_m - 0.00101F);
        EXPECT_GE(pair.distance_m, before.size() > 1 ? before.back().distance_m : 0);
        EXPECT_LE(pair.distance_m, 0.5F);
        EXPECT_LE(pair.lower_bound_m, pair.distance_m);
        EXPECT_LE(pair.distance_m - pair.lower_bound_m, 0.01F);
        EXPECT_NEAR((pair.obstacle_point_B_m - pair.robot_point_B_m).norm(), pair.distance_m, 2e-6);
        EXPECT_LE(mesh_L(X_LB * pair.robot_point_B_m.cast<double>()).distance_m, 1e-5);
        for (const SpacePair& other : before) {
          EXPECT_GE((pair.robot_point_B_m - other.robot_point_B_m).norm(), kApart_m);
        }
        before.push_back(pair);
        ++count;
      }
    }
  }
  EXPECT_GT(count, 50U);
}

TEST_F(Candidates, NoEighthThatIsNearerIsLeftOut) {
  Query query(robot);
  const Result& result = query.ask({newest, scene.cameras[0].at_exposure[10]});
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> eighths;
  mesh_distances(robot->eighths(), result.pose, query.frames().space(), {.range_m = 0.5}, workspace,
                 eighths);
  for (std::size_t i = 0; i < eighths.size(); ++i) {
    const SpacePair& pair = eighths[i].nearest;
    const auto& links = robot->model().evaluated_links;
    const auto place = std::ranges::find(links, robot->eighths().links[i].link) - links.begin();
    const LinkResult& link = result.links[static_cast<std::size_t>(place)];
    if (!pair.is_known() || link.candidates.empty()) continue;
    // What is nearer than the last candidate is one, or lies beside one.
    if (pair.distance_m >= link.candidates.back().distance_m - 0.002F) continue;
    std::vector<SpacePair> told(link.candidates.begin(), link.candidates.end());
    told.push_back(link);
    const bool is_told = std::ranges::any_of(told, [&](const SpacePair& other) {
      return (other.robot_point_B_m - pair.robot_point_B_m).norm() < kApart_m + 0.002F;
    });
    EXPECT_TRUE(is_told) << link.link;
  }
}

/// How fast a pair's distance grows with a joint, by moving its two points with their links.
double slope(const RobotModel& model, const JointState& joints, std::size_t joint, std::size_t link,
             std::optional<std::size_t> other, const Eigen::Vector3f& p_B_m,
             const Eigen::Vector3f& q_B_m) {
  constexpr double kStep = 1e-5;
  RobotPose pose, moved;
  forward_kinematics(model, joints.position, pose);
  const auto distance_m = [&](double step) {
    std::vector<double> position = joints.position;
    position[joint] += step;
    forward_kinematics(model, position, moved);
    const auto carried = [&](std::size_t by, const Eigen::Vector3f& point_B_m) -> Eigen::Vector3d {
      return moved.X_BL[by] * (pose.X_BL[by].inverse() * point_B_m.cast<double>());
    };
    const Eigen::Vector3d there = other ? carried(*other, q_B_m) : q_B_m.cast<double>();
    return (carried(link, p_B_m) - there).norm();
  };
  return (distance_m(kStep) - distance_m(-kStep)) / (2 * kStep);
}

TEST_F(Candidates, EachPairTellsHowItsDistanceChangesWhereGradientsAreAskedFor) {
  EvaluationSettings settings = robot->settings();
  settings.gradient = true;
  const auto told = with_settings(robot, settings);
  const RobotModel& model = told->model();
  const JointState joints = scene.cameras[0].at_exposure[10];
  Query query(told);
  const Result& result = query.ask({newest, joints});
  int compared = 0;
  for (const LinkResult& link : result.links) {
    const std::size_t index = model.evaluated_links[link.id - 1];
    const auto compare = [&](const auto& pair, std::optional<std::size_t> other) {
      ASSERT_EQ(pair.gradient.size(), model.joints.size());
      for (std::size_t j = 0; j < model.joints.size(); ++j) {
        if (!pair.is_known()) {
          EXPECT_TRUE(std::isnan(pair.gradient[j]));
        } else if (pair.distance_m > 0) {
          EXPECT_NEAR(
              pair.gradient[j],
              slope(model, joints, j, index, other, pair.robot_point_B_m, pair.obstacle_point_B_m),
              1e-3);
          ++compared;
        }
      }
    };
    compare(static_cast<const ToldPair&>(link), std::nullopt);
    compare(link.occupied, std::nullopt);
    if (link.known.is_known()) compare(link.known, static_cast<std::size_t>(link.known.link));
    for (const ToldPair& pair : link.candidates) compare(pair, std::nullopt);
  }
  EXPECT_GT(compared, 150);
  const Result& late = query.ask({.frames = newest, .now_s = frames[0].stamp_s + 10});
  for (const LinkResult& link : late.links) {
    ASSERT_EQ(link.known.gradient.size(), model.joints.size());
    EXPECT_TRUE(std::isnan(link.gradient[0]) && std::isnan(link.known.gradient[0]));
  }
}

TEST_F(Candidates, AStaleResultHasNone) {
  Query query(robot);
  ASSERT_FALSE(query.ask({newest}).links.back().candidates.empty());
  const Result& late = query.ask({.frames = newest, .now_s = frames[0].stamp_s + 10});
  EXPECT_EQ(late.status, ResultStatus::stale);
  for (const LinkResult& link : late.links) EXPECT_TRUE(link.candidates.empty());
}

class OneCandidate : public Candidates {
 protected:
  OneCandidate() : Candidates(1) {}
};

TEST_F(OneCandidate, IsTheLinksOwnPair) {
  Query query(robot);
  const Result& result = query.ask({newest});
  EXPECT_FALSE(result.has_candidates);
  for (const LinkResult& link : result.links) EXPECT_TRUE(link.candidates.empty());
}

}  // namespace
}  // namespace berth
