// An arm with goals reaches them, and touches nobody and nothing that it knows.
#include <gtest/gtest.h>

#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/goals.hpp"
#include "lab/closed_loop/policies.hpp"
#include "lab/closed_loop/simulation.hpp"
#include "sim/known_check.hpp"

namespace berth::lab {
namespace {

EncounterResult run(double presence, double most_s) {
  SimulationSettings settings;
  settings.presence = presence;
  settings.most_s = most_s;
  return simulate(101, *make_supervisor("filter", settings.request_hz), settings);
}

TEST(Goals, AreReachedInAnEmptyRoom) {
  const EncounterResult result = run(0, 3);
  EXPECT_GE(result.reached, 2);
  EXPECT_GT(result.phase_s, 0.85 * result.duration_s);
  EXPECT_EQ(result.contact_m_s, 0);
  EXPECT_GT(result.least_known_m, 0.05);
}

TEST(Goals, AreReachedBesideSomebodyWhoReachesInAndIsNotTouched) {
  // The check finds an arm that lies on its table.
  const RobotModel& model = cell_model();
  sim::KnownCheck check(model);
  RobotPose pose;
  std::vector<double> position = stations_rad().front();
  forward_kinematics(model, position, pose);
  check.add(pose, 1);
  EXPECT_EQ(check.contact_m_s(), 0);
  position[1] = 1.6;
  forward_kinematics(model, position, pose);
  check.add(pose, 1);
  EXPECT_EQ(check.contact_m_s(), 1);

  const EncounterResult result = run(1, 4);
  EXPECT_GE(result.reached, 3);
  EXPECT_EQ(result.contact_m_s, 0);
  EXPECT_GT(result.least_moving_m, 0.3);
  EXPECT_GT(result.least_known_m, 0.05);
}

}  // namespace
}  // namespace berth::lab
