// A fault in each input stops the arm within the time that the protective distance assumes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/policies.hpp"
#include "lab/closed_loop/simulation.hpp"

namespace berth::lab {
namespace {

/// Nobody is there; the arm goes at full speed until the fault.
EncounterResult run_with(Fault fault, const char* policy = "path") {
  SimulationSettings settings;
  settings.presence = 0;
  settings.fault = fault;
  settings.fault_s = 1.5;
  settings.most_s = 2.5;
  return simulate(3, *make_supervisor(policy, settings.request_hz), settings);
}

/// S holds for images up to this old, and a request comes after that.
double assumed_s() {
  const SimulationSettings settings;
  return TimeSettings().max_frame_age_s + 1 / settings.request_hz + 0.001;
}

/// From its greatest speed.
constexpr double kStopping_s = 1.5 / kArmDeceleration_m_s2;

struct NamedFault {
  std::string name;
  Fault fault;
};

class Faults : public ::testing::TestWithParam<std::tuple<NamedFault, std::string>> {};

TEST_P(Faults, StopTheArmInTime) {
  const auto& [fault, policy] = GetParam();
  const EncounterResult result = run_with(fault.fault, policy.c_str());
  EXPECT_GT(result.phase_s, 0.5) << "it moved before";
  EXPECT_LE(result.commanded_stop_s, assumed_s());
  EXPECT_LE(result.stopped_s, assumed_s() + kController_s + kStopping_s);
}

INSTANTIATE_TEST_SUITE_P(
    All, Faults,
    ::testing::Combine(::testing::Values(NamedFault{"late_images", Fault::late_images},
                                         NamedFault{"no_images", Fault::no_images},
                                         NamedFault{"covered_camera", Fault::covered_camera},
                                         NamedFault{"no_joints", Fault::no_joints},
                                         NamedFault{"not_a_number", Fault::not_a_number}),
                       ::testing::Values("path", "formula")),
    [](const auto& test) { return std::get<0>(test.param).name + "_" + std::get<1>(test.param); });

// It is found where the arm is not seen where it should be: not within a frame.
TEST(OtherFaults, ACameraThatWasBumpedIntoStopsTheArm) {
  const EncounterResult result = run_with(Fault::moved_camera);
  EXPECT_LE(result.commanded_stop_s, 0.6);
}

// On the way to a person who reaches in.
TEST(OtherFaults, AControllerThatObeysAsLateAsSaidHitsNobody) {
  SimulationSettings settings;
  settings.fault = Fault::late_controller;
  // Then the person is 0.9 m away, and goes.
  settings.most_s = 7.4;
  for (const char* policy : {"path", "formula"}) {
    const EncounterResult result =
        simulate(2, *make_supervisor(policy, settings.request_hz), settings);
    EXPECT_EQ(result.contact_m_s, 0) << policy;
    EXPECT_GT(result.least_moving_m, 0.1) << policy;
  }
}

// Joint states that say what is not true come in time. The cameras see the arm where it should not
// be: once it is beyond the filter's tolerance, it is an obstacle to itself.
TEST(OtherFaults, JointsThatStandStillWhileTheArmMovesStopItOnceItIsSeen) {
  const EncounterResult result = run_with(Fault::frozen_joints);
  EXPECT_LE(result.commanded_stop_s, 0.6);
}

TEST(OtherFaults, WithoutOneTheArmGoesOn) {
  const EncounterResult result = run_with(Fault::none);
  EXPECT_TRUE(std::isnan(result.commanded_stop_s));
  EXPECT_GT(result.phase_s, 1.5);
}

}  // namespace
}  // namespace berth::lab
