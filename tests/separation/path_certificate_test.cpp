// The greatest speed along a way, held against cold searches at many poses of it.
#include "berth/separation/path_certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/separation/monitor.hpp"
#include "berth/separation/protective_distance.hpp"
#include "tests/support/thinned.hpp"

namespace berth {
namespace {

constexpr double kAdded_m = 0.03, kReaction_s = 0.15, kTravel_s = 0.1;

SeparationSettings slow_people() {
  SeparationSettings settings;
  settings.human_speed_m_s = 0.15;
  settings.deceleration_m_s2 = 1.5;
  settings.acceleration_m_s2 = 0;
  return settings;
}

/// The bundled scene at one time, with the robot on a drawn way.
class PathCertificates : public ::testing::Test {
 protected:
  PathCertificates()
      : scene_(open_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")), query_(scene_.robot) {
    std::vector<std::shared_ptr<const Frame>> frames;
    for (std::size_t c = 0; c < scene_.cameras.size(); ++c) {
      const OpenCamera& camera = scene_.cameras[c];
      auto frame = std::make_shared<Frame>();
      Observer(camera.mounted).observe(camera.read_depth(5), camera.at_exposure[5], *frame);
      frames.push_back(frame);
    }
    kept_ = frames;
    result_ = query_.ask({.frames = kept_});
    position_ = scene_.cameras[0].at_exposure[5].position;
    forward_kinematics(scene_.robot->model(), position_, now_);
    result_ = query_.ask({.frames = kept_, .joints = JointState{0, position_}});
    for (std::size_t i = 0; i < result_.links.size(); ++i) {
      const std::size_t index = scene_.robot->model().evaluated_links[i];
      hulls_.push_back(hull_points(scene_.robot->model().links[index].mesh_L));
      links_.push_back({.is_moved = scene_.robot->model().is_moved(index),
                        .added_m = kAdded_m,
                        .known_m = result_.links[i].lower_bound_m,
                        .assumed_m = result_.links[i].lower_bound_m});
    }
  }

  std::vector<double> on_way(double time_s) const {
    std::vector<double> out = position_;
    for (std::size_t j = 0; j < out.size(); ++j) {
      out[j] += time_s * velocity_[j] + time_s * time_s * bend_[j];
    }
    return out;
  }

  void draw_way(std::uint32_t seed, bool is_curved) {
    std::mt19937 random(seed);
    const auto draw = [&](double most) {
      return most * (2 * static_cast<double>(random()) / 4294967296.0 - 1);
    };
    velocity_.clear();
    bend_.clear();
    path_.clear();
    for (std::size_t j = 0; j < position_.size(); ++j) {
      velocity_.push_back(draw(0.7));
      bend_.push_back(is_curved ? draw(0.5) : 0);
    }
    if (!is_curved) return;
    for (int i = 0; i <= 400; ++i) path_.push_back({0.01 * i, on_way(0.01 * i)});
  }

  double fastest_step_m(const RobotPose& a, const RobotPose& b) const {
    double most_m = 0;
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      if (!links_[i].is_moved) continue;
      const std::size_t link = scene_.robot->model().evaluated_links[i];
      for (const Eigen::Vector3f& p : hulls_[i].points_L_m) {
        const Eigen::Vector3d p_L = p.cast<double>();
        most_m = std::max(most_m, (a.X_BL[link] * p_L - b.X_BL[link] * p_L).norm());
      }
    }
    return most_m;
  }
  RobotPose pose_at(double time_s) const {
    RobotPose pose;
    forward_kinematics(scene_.robot->model(), on_way(time_s), pose);
    return pose;
  }

  PathRequest request() {
    constexpr double kStep_s = 1e-4;
    planned_m_s_ = fastest_step_m(pose_at(0), pose_at(kStep_s)) / kStep_s;
    motion_ = PlannedMotion(velocity_, path_);
    return {.pose = now_,
            .motion = motion_,
            .space = query_.frames().space(),
            .reaction_time_s = kReaction_s,
            .travel_time_s = kTravel_s,
            .planned_m_s = planned_m_s_,
            .robot_m_s = planned_m_s_,
            .links = links_};
  }

  /// The slow twin: by how much the least room of any link, anywhere on its way until it stands,
  /// is more than needed. A step of the way at a time, each searched from the start.
  double least_margin_m(const SeparationSettings& settings, double scale) const {
    constexpr double kStep_s = 0.02;
    double fastest_m_s = planned_m_s_;
    for (double t = 0; t < scale * kTravel_s; t += kStep_s / 4) {
      fastest_m_s = std::max(fastest_m_s,
                             fastest_step_m(pose_at(t), pose_at(t + kStep_s / 4)) / (kStep_s / 4));
    }
    const double a = settings.deceleration_m_s2;
    const double stops_s = scale * fastest_m_s / a;
    double way_m = 0, braked_m = 0, least_m = 10;
    for (double t = 0; braked_m < a * stops_s * stops_s / 2; t += kStep_s * scale) {
      const RobotPose pose = pose_at(t), next = pose_at(t + kStep_s * scale);
      const double needed_m =
          settings.human_speed_m_s * (kReaction_s + std::min(stops_s, std::sqrt(2 * way_m / a))) +
          kAdded_m;
      MeshWorkspace workspace;
      std::vector<WholeLinkDistance> found;
      mesh_distances(*scene_.robot->patches(), pose, query_.frames().space(),
                     {.range_m = 1, .tolerance_m = 1e-3}, workspace, found);
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (!links_[i].is_moved || !found[i].nearest.is_known()) continue;
        least_m = std::min(least_m, found[i].nearest.distance_m - needed_m);
      }
      const double step_m = fastest_step_m(pose, next);
      way_m += step_m;
      if (t >= scale * kTravel_s) braked_m += step_m;
      if (way_m > 3) break;
    }
    return least_m;
  }

  OpenScene scene_;
  Query query_;
  std::vector<std::shared_ptr<const Frame>> kept_;
  Result result_;
  std::vector<double> position_;
  RobotPose now_;
  std::vector<HullPoints> hulls_;
  std::vector<PathLink> links_;
  std::vector<double> velocity_;
  std::vector<double> bend_;
  std::vector<JointState> path_;
  PlannedMotion motion_;
  double planned_m_s_ = 0;
};

TEST_F(PathCertificates, HoldWhereverTheRobotIsAndLeaveLittleAside) {
  const SeparationSettings settings = slow_people();
  PathCertificate certificate(scene_.robot, settings, hulls_);
  int between = 0;
  for (std::uint32_t seed = 0; seed < 2 + thinned(6u); ++seed) {
    draw_way(seed, seed % 2 == 1);
    const double scale = certificate.greatest_scale(request(), 0, 0.5, 1).scale;
    SCOPED_TRACE(::testing::Message() << seed << " scale " << scale);
    EXPECT_LE(certificate.steps(), PathCertificate::kMostSteps);
    if (scale > 0) {
      EXPECT_GE(least_margin_m(settings, scale), -1e-4);
    }
    if (scale >= 1) continue;
    ++between;
    EXPECT_LT(least_margin_m(settings, std::min(1.0, scale + 0.15)), 0.02);
  }
  EXPECT_GE(between, 2);
}

TEST_F(PathCertificates, AreTheSameWhereverTheSearchBegins) {
  SeparationSettings settings = slow_people();
  settings.human_speed_m_s = 0.05;
  PathCertificate certificate(scene_.robot, settings, hulls_);
  draw_way(2, false);
  const double scale = certificate.greatest_scale(request(), 0, 0, 1).scale;
  ASSERT_GT(scale, 0);
  for (const double before : {0.2, 0.7, 1.0}) {
    EXPECT_NEAR(certificate.greatest_scale(request(), 0, before, 1).scale, scale, 0.03);
  }
}

TEST_F(PathCertificates, WhatMayBeAnywhereIsWhereverTheLinkGoes) {
  SeparationSettings settings = slow_people();
  settings.human_speed_m_s = 0.05;
  PathCertificate certificate(scene_.robot, settings, hulls_);
  draw_way(2, false);
  const double scale = certificate.greatest_scale(request(), 0, 0.5, 1).scale;
  ASSERT_GT(scale, 0);
  for (PathLink& link : links_) link.assumed_m = std::min(link.known_m, 0.04);
  const double assumed = certificate.greatest_scale(request(), 0, 0.5, 1).scale;
  EXPECT_LT(assumed, scale);
  for (PathLink& link : links_) link.assumed_m = 0;
  EXPECT_EQ(certificate.greatest_scale(request(), 0, 0.5, 1).scale, 0);
}

TEST_F(PathCertificates, AskForNothingWhereTheWayIsNotTold) {
  PathCertificate certificate(scene_.robot, slow_people(), hulls_);
  draw_way(3, true);
  path_.resize(5);
  EXPECT_EQ(certificate.greatest_scale(request(), 0.04, 0.5, 1).scale, 0.04);
  EXPECT_EQ(certificate.steps(), 0);
}

/// A box on a rail.
constexpr const char* kSlider =
    "<robot name=\"slider\"><link name=\"base\"/><link name=\"box\"><visual><geometry>"
    "<box size=\"0.2 0.2 0.2\"/></geometry></visual></link><joint name=\"slide\" "
    "type=\"prismatic\">"
    "<parent link=\"base\"/><child link=\"box\"/><axis xyz=\"1 0 0\"/>"
    "<limit lower=\"-5\" upper=\"5\" effort=\"1\" velocity=\"1\"/></joint></robot>";

std::shared_ptr<const Robot> slider() {
  RobotSettings settings;
  settings.urdf = "slider.urdf";
  settings.urdf_text = kSlider;
  EvaluationSettings evaluation;
  evaluation.distance.range_m = 4;
  return std::make_shared<const Robot>(load_robot(settings), evaluation);
}

/// Looks along x, from above the rail, at a wall.
Frame wall_frame(const std::shared_ptr<const Robot>& robot, float wall_x_m) {
  const Camera camera{64, 48, 40, 40, 31.5, 23.5};
  Pose X_BC = Pose::Identity();
  X_BC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_BC.translation() = Eigen::Vector3d(-1, 0, 0.1);
  CameraSettings settings;
  settings.self_filter.tolerance_m = 0.02;
  const auto mounted = std::make_shared<const MountedCamera>(
      robot, CameraMount{camera, "base", X_BC, "above"}, settings);
  DepthImage depth_m(64, 48, wall_x_m + 1);
  Frame frame;
  FrameTime time;
  Observer(mounted).observe(depth_m, JointState{0, {0.0}}, frame);
  return frame;
}

/// A request about the box, and the greatest scale for it, between `least` and `most`.
struct SliderCase {
  const std::shared_ptr<const Robot>& robot;
  const SeparationSettings& settings;
  const Result& result;
  const UnknownSpace& space;
  /// Along the rail.
  double velocity_m_s;
  double contact_m_s = 0;

  double greatest_scale(double least, double before, double most) const {
    const std::vector<HullPoints> hulls = {hull_points(robot->model().links[1].mesh_L)};
    const double distance_m = result.links[0].occupied.lower_bound_m;
    const std::vector<PathLink> links = {
        {true, settings.robot_uncertainty_m, distance_m, distance_m}};
    const std::vector<double> velocity = {velocity_m_s};
    return PathCertificate(robot, settings, hulls)
        .greatest_scale({.pose = result.pose,
                         .motion = velocity,
                         .space = space,
                         .reaction_time_s = settings.reaction_time_s,
                         .travel_time_s = settings.reaction_time_s,
                         .planned_m_s = std::abs(velocity_m_s),
                         .robot_m_s = std::abs(velocity_m_s),
                         .contact_m_s = contact_m_s,
                         .links = links},
                        least, before, most)
        .scale;
  }
};

TEST(PathCertificate, TheFormulaIsNeverLessCarefulWhereTheRobotRunsStraightAtTheObstacle) {
  const auto robot = slider();
  SeparationSettings settings;
  settings.intrusion_m = 0;
  settings.camera_uncertainty_m = 0;
  settings.acceleration_m_s2 = 0;
  settings.unknown = settings.not_seen = UnknownPolicy::ignore;
  settings.no_reading = UnknownPolicy::ignore;
  int between = 0;
  for (const float wall_m : {0.4F, 0.7F, 1.0F, 1.3F, 1.6F, 2.0F}) {
    const Frame frame = wall_frame(robot, wall_m);
    Query query(robot);
    const Result result = query.ask({.frames = frame, .joints = JointState{0, {0.0}}});
    ASSERT_EQ(result.time.status, TimeStatus::ok);
    const double distance_m = result.links[0].occupied.lower_bound_m;
    EXPECT_NEAR(distance_m, wall_m - 0.1, 0.03);
    for (const double speed : {0.3, 0.8, 1.5}) {
      const std::vector<double> velocity = {speed};
      const double formula =
          SeparationMonitor(robot, settings).update(result, velocity, 0).speed_scale;
      const SliderCase asked{robot, settings, result, query.frames().space(), speed};
      const double path = asked.greatest_scale(0, formula, std::min(1.0, formula + 0.15));
      // The scale is found to a step, and the way is cut into pieces.
      EXPECT_LE(formula, path + 0.03) << wall_m << ' ' << speed;
      EXPECT_LE(path, formula + 0.1) << "it runs straight at it: there is nothing to be gained";
      between += formula > 0 && formula < 1;
    }
  }
  EXPECT_GT(between, 3);
}

/// The greatest scale at which a box that drives away from a wall always has its room, by the
/// definition at each tenth of a millimetre.
double greatest_scale_away(const SeparationSettings& settings, double distance_m, double speed_m_s,
                           double contact_m_s) {
  const double a = settings.deceleration_m_s2;
  const auto has_room = [&](double scale) {
    const double stops_s = std::max(0.0, scale * speed_m_s - contact_m_s) / a;
    for (double x_m = 0; x_m < 1.5; x_m += 1e-4) {
      const double within_s =
          (std::sqrt(contact_m_s * contact_m_s + 2 * a * x_m) - contact_m_s) / a;
      const double needed_m =
          settings.human_speed_m_s * (settings.reaction_time_s + std::min(stops_s, within_s)) +
          settings.robot_uncertainty_m;
      if (distance_m + x_m < needed_m) return false;
    }
    return true;
  };
  if (has_room(1)) return 1;
  double scale = 0, too_much = 1;
  while (too_much - scale > 1e-4) {
    const double middle = (scale + too_much) / 2;
    (has_room(middle) ? scale : too_much) = middle;
  }
  return scale;
}

TEST(PathCertificate, NeedsWhatTheDefinitionSaysWhereTheRobotDrivesAway) {
  const auto robot = slider();
  SeparationSettings settings;
  settings.acceleration_m_s2 = 0;
  settings.unknown = UnknownPolicy::ignore;
  int between = 0;
  for (float wall_m = 0.3F; wall_m < 1.2F; wall_m += 0.06F) {
    const Frame frame = wall_frame(robot, wall_m);
    Query query(robot);
    const Result result = query.ask({.frames = frame, .joints = JointState{0, {0.0}}});
    for (const double speed : {0.3, 0.8, 1.5}) {
      for (const double contact_m_s : {0.0, 0.1, 0.25}) {
        SCOPED_TRACE(::testing::Message() << wall_m << ' ' << speed << ' ' << contact_m_s);
        const SliderCase asked{robot,  settings,   result, query.frames().space(),
                               -speed, contact_m_s};
        const double found = asked.greatest_scale(0, 0.5, 1);
        const double exact =
            greatest_scale_away(settings, result.links[0].occupied.distance_m, speed, contact_m_s);
        EXPECT_LE(found, exact + 1e-3);
        EXPECT_GE(found, exact - 0.07);
        between += exact > 0 && exact < 1;
      }
    }
  }
  EXPECT_GT(between, 20);
}

}  // namespace
}  // namespace berth
