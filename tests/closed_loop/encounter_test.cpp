// The simulation itself: people, arm and contact check are what they say.
#include "sim/encounter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "berth/calibration/calibrate.hpp"
#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/cell_sensors.hpp"
#include "lab/closed_loop/moving_arm.hpp"
#include "lab/closed_loop/policies.hpp"
#include "lab/closed_loop/simulation.hpp"
#include "sim/contact_check.hpp"
#include "sim/moving_ray_caster.hpp"
#include "sim/person.hpp"

namespace berth::lab {
namespace {

TEST(ClosedLoop, NobodyIsFasterThanTheySay) {
  const std::vector<TriangleMesh> parts = sim::make_person_meshes();
  for (const std::uint32_t seed : {0U, 1U, 2U}) {
    const sim::Encounter encounter(seed);
    EXPECT_LE(encounter.speed_m_s(), 1.6);
    double fastest_m_s = 0;
    constexpr double kStep_s = 0.005;
    for (double t = 0; t + kStep_s < encounter.duration_s(); t += kStep_s) {
      const std::vector<Pose> a = encounter.pose_at(t), b = encounter.pose_at(t + kStep_s);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = 0; k < parts[i].vertices_m.size(); k += 40) {
          const Eigen::Vector3d p = parts[i].vertices_m[k].cast<double>();
          fastest_m_s = std::max(fastest_m_s, (a[i] * p - b[i] * p).norm() / kStep_s);
        }
      }
    }
    EXPECT_LE(fastest_m_s, 1.03 * encounter.speed_m_s()) << seed;
    EXPECT_GE(fastest_m_s, 0.9 * encounter.speed_m_s()) << seed;
  }
}

TEST(ClosedLoop, TheArmsSpeedChangesNoFasterThanItsMotorsAllow) {
  const RobotModel& model = cell_model();
  MovingArm arm(model, 0.1);
  // Speeds of points are computed in single precision, and divided by a millisecond here.
  constexpr double kRounding_m_s2 = 1e-3;
  double before_m_s = 0, fastest_m_s = 0;
  for (int i = 0; i < 6000; ++i) {
    arm.step(i / 1000 % 2 == 0 ? 1 : 0, 0.001);
    const double change = (arm.fastest_m_s() - before_m_s) / 0.001;
    EXPECT_LE(change, kArmAcceleration_m_s2 + kRounding_m_s2) << i;
    // Where the path itself slows down, its corner may be sharper than the brake.
    if (i / 1000 % 2 == 1) {
      EXPECT_GE(change, -2 * kArmDeceleration_m_s2) << i;
    }
    before_m_s = arm.fastest_m_s();
    fastest_m_s = std::max(fastest_m_s, before_m_s);
  }
  EXPECT_EQ(before_m_s, 0);
  EXPECT_GT(fastest_m_s, 0.8);
}

TEST(ClosedLoop, ImagesBeforeWhatStandsStillAreThoseOfEverythingAtOnce) {
  const RobotModel& model = cell_model();
  const sim::Encounter encounter(2);
  MovingArm arm(model, encounter.first_phase());
  std::vector<TriangleMesh> meshes[2];
  const auto poses_of = [&](bool is_moved) {
    std::vector<Pose> X_BL;
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const bool is_wanted = model.is_moved(i) == is_moved && !model.links[i].mesh_L.empty();
      if (is_wanted) X_BL.push_back(arm.pose().X_BL[i]);
    }
    return X_BL;
  };
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const TriangleMesh& mesh_L = model.links[i].mesh_L;
    if (!mesh_L.empty()) meshes[model.is_moved(i)].push_back(mesh_L);
  }
  for (const TriangleMesh& part : sim::make_person_meshes()) meshes[1].push_back(part);
  std::vector<TriangleMesh> all = meshes[0];
  all.insert(all.end(), meshes[1].begin(), meshes[1].end());
  sim::MovingRayCaster at_once(all), still(meshes[0]), moving(meshes[1]);
  int moved_px = 0;
  for (int i = 0; i < 4; ++i) {
    std::vector<Pose> X_BP = encounter.pose_at(encounter.duration_s() * (i + 1) / 5);
    for (const CellCamera& camera : cell_cameras()) {
      // A part around the camera, too.
      if (i == 3) X_BP[0] = camera.X_BC;
      for (int step = 0; step < 300; ++step) arm.step(1, 0.001);
      std::vector<Pose> X_BM = poses_of(true);
      X_BM.insert(X_BM.end(), X_BP.begin(), X_BP.end());
      std::vector<Pose> X_BA = poses_of(false);
      DepthImage depth_m = still.cast(camera.camera, camera.X_BC, X_BA);
      const DepthImage still_m = depth_m;
      moving.cast_before(camera.camera, camera.X_BC, X_BM, depth_m);
      X_BA.insert(X_BA.end(), X_BM.begin(), X_BM.end());
      const DepthImage expected_m = at_once.cast(camera.camera, camera.X_BC, X_BA);
      for (int v = 0; v < depth_m.height(); ++v) {
        for (int u = 0; u < depth_m.width(); ++u) {
          ASSERT_EQ(std::bit_cast<int>(depth_m(u, v)), std::bit_cast<int>(expected_m(u, v)));
          moved_px += depth_m(u, v) != still_m(u, v);
        }
      }
    }
  }
  EXPECT_GT(moved_px, 100000);
}

TEST(ClosedLoop, TheContactCheckFindsWhatFclFindsAtEachStep) {
  const RobotModel& model = cell_model();
  const sim::TrueClearance clearance(model, sim::make_person_meshes());
  const sim::Encounter encounter(2);
  MovingArm arm(model, encounter.first_phase());
  sim::ContactCheck check(clearance);
  double least_m = std::numeric_limits<double>::infinity();
  const double middle_s = encounter.duration_s() / 2;
  for (double t = middle_s - 0.6; t < middle_s + 0.6; t += 0.02) {
    for (int i = 0; i < 20; ++i) arm.step(1, 0.001);
    const sim::ContactSample sample{t, arm.pose(), encounter.pose_at(t), arm.fastest_m_s()};
    if (check.is_due(t)) check.add(sample);
    const double now_m = clearance.at(sample.pose, sample.X_BP);
    EXPECT_LE(clearance.at_least(sample.pose, sample.X_BP), now_m + 1e-6);
    if (sample.fastest_m_s >= sim::kMoving_m_s) least_m = std::min(least_m, now_m);
  }
  check.finish();
  EXPECT_NEAR(check.least_moving_m(), least_m, 1e-9);
}

TEST(ClosedLoop, WithoutAMonitorSomebodyIsHit) {
  const auto nobody = make_supervisor("none", SimulationSettings().request_hz);
  double fastest_m_s = 0;
  for (std::uint32_t seed = 0; seed < 6 && fastest_m_s <= 0.2; ++seed) {
    fastest_m_s = simulate(seed, *nobody, {}).contact_m_s;
  }
  EXPECT_GT(fastest_m_s, 0.2);
}

TEST(ClosedLoop, TheMonitorStopsTheArmBeforeAnybodyIsThere) {
  const auto monitor = make_supervisor("path", SimulationSettings().request_hz);
  std::vector<LoopSample> samples;
  SimulationSettings settings;
  settings.most_s = 5;
  const EncounterResult result = simulate(2, *monitor, settings, &samples);
  EXPECT_EQ(result.contact_m_s, 0);
  EXPECT_GT(result.least_moving_m, 0.2);
  EXPECT_GT(result.phase_s, 0.5) << "it moved, where nobody was near";
  const auto slows = [](const LoopSample& sample) { return sample.scale > 0 && sample.scale < 1; };
  EXPECT_TRUE(std::ranges::any_of(samples, slows));
  // Nobody comes nearer than that it may creep.
  EXPECT_LT(std::ranges::min_element(samples, {}, &LoopSample::clearance_m)->fastest_m_s, 0.1);
}

TEST(ClosedLoop, NoVisitorIsFasterThanPeopleAre) {
  for (std::size_t kind = 0; kind < sim::kVisitKindNames.size(); ++kind) {
    if (static_cast<sim::VisitKind>(kind) == sim::VisitKind::bvh) continue;
    const sim::Visit visit(static_cast<sim::VisitKind>(kind), 4);
    const std::vector<TriangleMesh> parts = visit.meshes();
    constexpr double kStep_s = 0.01;
    double fastest_m_s = 0;
    const double end_s = visit.duration_s() + visit.lead_s();
    for (double t = -visit.lead_s(); t + kStep_s < end_s; t += kStep_s) {
      const std::vector<Pose> a = visit.pose_at(t), b = visit.pose_at(t + kStep_s);
      ASSERT_EQ(a.size(), parts.size());
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t k = 0; k < parts[i].vertices_m.size(); k += 40) {
          const Eigen::Vector3d p = parts[i].vertices_m[k].cast<double>();
          fastest_m_s = std::max(fastest_m_s, (a[i] * p - b[i] * p).norm() / kStep_s);
        }
      }
    }
    EXPECT_LE(fastest_m_s, 1.65) << sim::kVisitKindNames[kind];
    EXPECT_GT(fastest_m_s, 0.3) << sim::kVisitKindNames[kind];
  }
}

TEST(ClosedLoop, NobodyIsThereForTheRestOfTheTime) {
  const auto nobody = make_supervisor("none", SimulationSettings().request_hz);
  SimulationSettings settings;
  const double always_s = simulate(1, *nobody, settings).duration_s;
  settings.presence = 0.5;
  const double half_s = simulate(1, *nobody, settings).duration_s;
  const sim::Visit visit(settings.kind, 1);
  EXPECT_NEAR(half_s, 2 * (always_s + 2 * visit.lead_s()), 0.01);
}

TEST(ClosedLoop, AConformingZoneIsLargerThanTheEncounters) {
  EXPECT_GT(conforming_zone_m(kArmFullSpeed_m_s), 2.2);
  EXPECT_LT(conforming_zone_m(0.25), conforming_zone_m(kArmFullSpeed_m_s));
  const RobotModel& model = cell_model();
  MovingArm arm(model, 0);
  double reach_m = 0, fastest_m_s = 0;
  for (double t = 0; t < cycle_s(); t += 0.02) {
    for (int k = 0; k < 20; ++k) arm.step(1, 0.001);
    fastest_m_s = std::max(fastest_m_s, arm.full_m_s());
    for (const std::size_t link : model.evaluated_links) {
      for (const Eigen::Vector3f& p : model.links[link].mesh_L.vertices_m) {
        const Eigen::Vector3d p_B = arm.pose().X_BL[link] * p.cast<double>();
        reach_m = std::max(reach_m, p_B.head<2>().norm());
      }
    }
  }
  EXPECT_NEAR(reach_m, 0.67, 0.02);
  EXPECT_NEAR(fastest_m_s, kArmFullSpeed_m_s, 0.1);
}

/// Images of the arm alone, all along its way.
std::vector<CalibrationCamera> cameras_to_calibrate(const RobotModel& model) {
  constexpr int kImages = 10;
  CellSensors sensors(model, {}, 5);
  std::vector<CalibrationCamera> cameras;
  for (const CellCamera& camera : cell_cameras()) {
    const int which = static_cast<int>(cameras.size());
    CalibrationCamera& to = cameras.emplace_back();
    to.name = camera.name;
    to.camera = camera.camera;
    to.X_PC = camera.X_BC;
    for (int i = 0; i < kImages; ++i) {
      const JointState joints{0, path_at(i * cycle_s() / kImages).position_rad};
      RobotPose pose;
      forward_kinematics(model, joints.position, pose);
      to.frames.push_back({i, sensors.take_image(which, pose, {}), joints});
    }
  }
  return cameras;
}

TEST(ClosedLoop, TheMonitorAllowsForWhatCalibrationLeavesUnexplained) {
  const auto robot = cell_robot();
  const std::vector<CalibrationCamera> cameras = cameras_to_calibrate(robot->model());
  CalibrationData data;
  data.model = &robot->model();
  data.meshes = robot->meshes();
  for (const CalibrationCamera& camera : cameras) data.cameras.push_back(&camera);
  double greatest_m = 0;
  for (const CameraCalibration& found : calibrate(data, {.is_near = true}).cameras) {
    greatest_m = std::max(greatest_m, found.after.p99_m);
  }
  EXPECT_LE(greatest_m, kCellReadingError_m);
  EXPECT_GE(greatest_m, 0.8 * kCellReadingError_m);
}

TEST(ClosedLoop, UnknownPoliciesAreRefused) {
  EXPECT_THROW(make_supervisor("brave", SimulationSettings().request_hz), std::invalid_argument);
}

}  // namespace
}  // namespace berth::lab
