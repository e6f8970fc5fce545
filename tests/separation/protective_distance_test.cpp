// The terms of the protective separation distance, one by one, and the speed that leaves room.
#include "berth/separation/protective_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/support/error_message.hpp"

namespace berth {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Every term is 0.
SeparationSettings no_terms() {
  SeparationSettings settings;
  settings.human_speed_m_s = 0;
  settings.deceleration_m_s2 = 1e12;
  settings.intrusion_m = settings.robot_uncertainty_m = 0;
  return settings;
}

TEST(ProtectiveDistance, IsTheSumOfItsTerms) {
  SeparationSettings settings;
  settings.human_speed_m_s = 1.6;
  settings.deceleration_m_s2 = 2;
  settings.intrusion_m = 0.2;
  settings.robot_uncertainty_m = 0.01;
  // T_s = 0.5 s, S_s = 0.25 m: 1.6 (0.2 + 0.5) + 1 x 0.2 + 0.25 + 0.2 + 0.05 + 0.01
  EXPECT_NEAR(protective_distance_m(settings, {0.2, 0.05}, {1, 1}), 1.83, 1e-12);
}

TEST(ProtectiveDistance, EachTermAlone) {
  EXPECT_NEAR(protective_distance_m(no_terms(), {0, 0}, {1, 1}), 0, 1e-9);
  SeparationSettings person = no_terms();
  person.human_speed_m_s = 1.6;
  EXPECT_NEAR(protective_distance_m(person, {0.25, 0}, {0, 0}), 0.4, 1e-12);
  EXPECT_NEAR(protective_distance_m(no_terms(), {0.25, 0}, {2, 2}), 0.5, 1e-9);
  SeparationSettings brake = no_terms();
  brake.deceleration_m_s2 = 4;
  EXPECT_NEAR(protective_distance_m(brake, {0, 0}, {2, 2}), 0.5, 1e-12);
  brake.human_speed_m_s = 1;
  EXPECT_NEAR(protective_distance_m(brake, {0, 0}, {2, 2}), 1, 1e-12)
      << "a person walks on for 0.5 s";
  SeparationSettings reach = no_terms();
  reach.intrusion_m = 0.3;
  EXPECT_NEAR(protective_distance_m(reach, {0, 0}, {0, 0}), 0.3, 1e-12);
  SeparationSettings place = no_terms();
  place.robot_uncertainty_m = 0.02;
  EXPECT_NEAR(protective_distance_m(place, {0, 0}, {0, 0}), 0.02, 1e-12);
  EXPECT_NEAR(protective_distance_m(no_terms(), {0, 0.07}, {0, 0}), 0.07, 1e-12);
  SeparationSettings seen = no_terms();
  seen.intrusion_m.reset();
  seen.detection_m = 0.02;
  EXPECT_NEAR(protective_distance_m(seen, {0, 0, 0.03}, {0, 0}), 0.128, 1e-12);
}

TEST(ProtectiveDistance, TheReachComesFromWhatTheCamerasDetect) {
  SeparationSettings settings;
  EXPECT_EQ(intrusion_m(settings), 0.85) << "nobody has shown anything";
  settings.detection_m = 0.040;
  EXPECT_NEAR(intrusion_m(settings), 0.208, 1e-12);
  settings.detection_m = 0.020;
  EXPECT_NEAR(intrusion_m(settings), 0.048, 1e-12);
  settings.detection_m = 0.010;
  EXPECT_EQ(intrusion_m(settings), 0);
  settings.detection_m = 0.041;
  EXPECT_EQ(intrusion_m(settings), 0.85);
  settings.detection_m = 0.020;
  EXPECT_NEAR(intrusion_m(settings, 0.030), 0.128, 1e-12) << "the cameras may miss more";
  EXPECT_NEAR(intrusion_m(settings, 0.010), 0.048, 1e-12);
  EXPECT_EQ(intrusion_m(settings, 0.041), 0.85);
  settings.intrusion_m = 0.3;
  EXPECT_EQ(intrusion_m(settings, 0.041), 0.3) << "what the user says counts";
}

TEST(ProtectiveDistance, TheLongestTimeToStopWithinAWay) {
  SeparationSettings settings;
  settings.deceleration_m_s2 = 2;
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.25, 9), 0.5, 1e-12);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.25, 0.4), 0.2, 1e-12);
  settings.stopping = {{0.5, 0.3, 0.05}, {1, 0.5, 0.25}};
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.25, 1), 0.5, 1e-5);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.15, 1), 0.4, 1e-5);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.01, 1), 0.3, 1e-5) << "a brake takes time to grip";
}

TEST(ProtectiveDistance, WhereAContactIsTolerableTheRobotOnlyBrakesDownToItsSpeed) {
  SeparationSettings settings = no_terms();
  settings.human_speed_m_s = 1;
  settings.deceleration_m_s2 = 2;
  EXPECT_NEAR(stopping_from(settings, 1, 0.5).time_s, 0.25, 1e-12);
  EXPECT_NEAR(stopping_from(settings, 1, 0.5).distance_m, 0.1875, 1e-12);
  EXPECT_EQ(stopping_from(settings, 0.4, 0.5).time_s, 0) << "it is slow enough";
  EXPECT_EQ(time_to_stop_within_s(settings, 0, 1, 0.5), 0);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.1875, 9, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.1875, 0.7, 0.5), 0.1, 1e-12);
  EXPECT_NEAR(protective_distance_m(settings, {.contact_m_s = 0.5}, {1, 1}), 0.25 + 0.1875, 1e-12);
  // A table does not say when the robot is so slow: what counts is when it stands.
  settings.stopping = {{0.5, 0.3, 0.05}, {1, 0.5, 0.25}};
  EXPECT_NEAR(stopping_from(settings, 1, 0.5).time_s, 0.5, 1e-12);
  EXPECT_NEAR(time_to_stop_within_s(settings, 0.25, 1, 0.5), 0.5, 1e-5);
}

TEST(ProtectiveDistance, ASlowLinkBrakesAsLongAsTheFastestPoint) {
  SeparationSettings settings = no_terms();
  settings.human_speed_m_s = 1;
  settings.deceleration_m_s2 = 2;
  // T_s = 2 / 2 s; on its way the link goes half of 0.5 m/s x 1 s.
  EXPECT_NEAR(protective_distance_m(settings, {0, 0}, {0.5, 2}), 1 + 0.25, 1e-12);
  settings.stopping = {{2, 0.8, 0.6}};
  EXPECT_NEAR(protective_distance_m(settings, {0, 0}, {0.5, 2}), 0.8 + 0.15, 1e-12);
}

TEST(ProtectiveDistance, GrowsWithEachTerm) {
  using Change = std::function<void(SeparationSettings&, ProtectiveTerms&, double& speed_m_s)>;
  const std::vector<Change> changes = {
      [](auto& s, auto&, double&) { s.human_speed_m_s += 0.1; },
      [](auto& s, auto&, double&) { s.deceleration_m_s2 *= 0.9; },
      [](auto& s, auto&, double&) { s.intrusion_m = intrusion_m(s) + 0.1; },
      [](auto& s, auto&, double&) { s.robot_uncertainty_m += 0.1; },
      [](auto&, auto& t, double&) { t.reaction_time_s += 0.01; },
      [](auto&, auto& t, double&) { t.camera_uncertainty_m += 0.01; },
      [](auto&, auto&, double& v) { v += 0.1; }};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.05, 2);
  for (int i = 0; i < 200; ++i) {
    SeparationSettings settings;
    settings.human_speed_m_s = number(random);
    settings.deceleration_m_s2 = number(random);
    const ProtectiveTerms terms{number(random), number(random)};
    const double speed_m_s = number(random);
    const double before_m = protective_distance_m(settings, terms, {speed_m_s, speed_m_s});
    for (std::size_t k = 0; k < changes.size(); ++k) {
      SeparationSettings more = settings;
      ProtectiveTerms more_terms = terms;
      double more_speed_m_s = speed_m_s;
      changes[k](more, more_terms, more_speed_m_s);
      EXPECT_GT(protective_distance_m(more, more_terms, {more_speed_m_s, more_speed_m_s}), before_m)
          << k;
    }
  }
}

std::vector<StoppingRow> table_of(double deceleration_m_s2, int rows, double to_m_s) {
  std::vector<StoppingRow> table;
  for (int i = 1; i <= rows; ++i) {
    const double v = to_m_s * i / rows;
    table.push_back({v, v / deceleration_m_s2, v * v / (2 * deceleration_m_s2)});
  }
  return table;
}

TEST(Stopping, ATableOfALinearBrakeIsThatBrakeOrMoreCareful) {
  SeparationSettings brake, table;
  brake.deceleration_m_s2 = 3;
  table.stopping = table_of(3, 40, 2);
  for (double v = 0.001; v < 2; v += 0.0037) {
    const Stopping by_brake = stopping_from(brake, v), by_table = stopping_from(table, v);
    EXPECT_GE(by_table.time_s, by_brake.time_s - 1e-12);
    EXPECT_GE(by_table.distance_m, by_brake.distance_m - 1e-12);
    EXPECT_LE(by_table.distance_m, by_brake.distance_m + 0.001);
    EXPECT_LE(by_table.time_s, by_brake.time_s + 0.05 / 3);
  }
}

TEST(Stopping, BelowTheTableItIsAsInItsFirstRow) {
  SeparationSettings settings;
  settings.stopping = {{0.5, 0.2, 0.06}, {1, 0.3, 0.2}};
  EXPECT_EQ(stopping_from(settings, 0.01).time_s, 0.2);
  EXPECT_EQ(stopping_from(settings, 0.01).distance_m, 0.06);
  EXPECT_EQ(stopping_from(settings, 0).time_s, 0) << "what stands still needs no brake";
  EXPECT_NEAR(stopping_from(settings, 0.75).time_s, 0.25, 1e-12);
  EXPECT_NEAR(stopping_from(settings, 0.75).distance_m, 0.13, 1e-12);
  EXPECT_EQ(stopping_from(settings, 1).distance_m, 0.2);
}

TEST(Stopping, AboveTheTableNoDistanceIsEnough) {
  SeparationSettings settings;
  settings.stopping = {{0.5, 0.2, 0.06}, {1, 0.3, 0.2}};
  settings.human_speed_m_s = 0;
  EXPECT_TRUE(std::isinf(protective_distance_m(settings, {0.1, 0}, {1.01, 1.01})));
  // So the scale brings the speed into the table, however far away everything is.
  EXPECT_NEAR(greatest_speed_scale(settings, {0.1, 0}, {2, 2}, 1000), 0.5, 1e-5);
}

TEST(GreatestSpeedScale, LeavesRoomAndHardlyMore) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> number(0.01, 2);
  int between = 0;
  for (int i = 0; i < 1000; ++i) {
    SeparationSettings settings;
    settings.human_speed_m_s = number(random);
    if (i % 2) settings.stopping = table_of(number(random), 5, 2);
    const ProtectiveTerms terms{0.2 * number(random), 0.02 * number(random)};
    const double speed_m_s = number(random), distance_m = 2 * number(random);
    const double scale = greatest_speed_scale(settings, terms, {speed_m_s, speed_m_s}, distance_m);
    if (scale == 0) continue;
    EXPECT_LE(protective_distance_m(settings, terms, {scale * speed_m_s, scale * speed_m_s}),
              distance_m);
    if (scale == 1) continue;
    ++between;
    EXPECT_GT(protective_distance_m(settings, terms,
                                    {(scale + 1e-5) * speed_m_s, (scale + 1e-5) * speed_m_s}),
              distance_m);
  }
  EXPECT_GT(between, 100);
}

TEST(GreatestSpeedScale, Is0WhereARobotThatStandsStillIsTooNear) {
  SeparationSettings settings;
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, 0.07}, {1, 1}, 0.3), 0);
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, 0.07}, {1, 1}, 0), 0);
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, 0.07}, {0, 0}, 0.3), 0);
}

TEST(GreatestSpeedScale, Is0WhereAnythingIsNotANumber) {
  const SeparationSettings settings;
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, 0.07}, {1, 1}, kNaN), 0);
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, 0.07}, {kNaN, kNaN}, 10), 0);
  EXPECT_EQ(greatest_speed_scale(settings, {kNaN, 0.07}, {1, 1}, 10), 0);
  EXPECT_EQ(greatest_speed_scale(settings, {0.2, kNaN}, {1, 1}, 10), 0);
}

TEST(SeparationSettings, AreCheckedWithNameValueAndWhatWasExpected) {
  const auto message = [](const std::function<void(SeparationSettings&)>& change) {
    SeparationSettings settings;
    change(settings);
    return error_message<std::invalid_argument>([&] { validate(settings); });
  };
  EXPECT_EQ(message([](auto& s) { s.human_speed_m_s = -1; }),
            "separation.human_speed_m_s: -1; expected a finite number of at least 0");
  EXPECT_EQ(message([](auto& s) { s.deceleration_m_s2 = 0; }),
            "separation.deceleration_m_s2: 0; expected a finite number above 0");
  EXPECT_EQ(message([](auto& s) { s.camera_uncertainty_m = kNaN; }),
            "separation.camera_uncertainty_m: nan; expected a finite number of at least 0");
  EXPECT_EQ(message([](auto& s) {
              s.stopping = {{1, 0.2, 0.1}, {1, 0.3, 0.2}};
            }),
            "separation.stopping[1].speed_m_s: 1; expected a finite number above 1");
  EXPECT_EQ(message([](auto& s) {
              s.stopping = {{1, 0.2, 0.1}, {2, 0.1, 0.2}};
            }),
            "separation.stopping[1].time_s: 0.1; expected a finite number of at least 0.2");
  EXPECT_EQ(message([](auto& s) {
              s.stopping = {{1, 0.2, 0.1}, {2, 0.3, 0.05}};
            }),
            "separation.stopping[1].distance_m: 0.05; expected a finite number of at least 0.1");
  EXPECT_EQ(message([](auto&) {}), "");
}

}  // namespace
}  // namespace berth
