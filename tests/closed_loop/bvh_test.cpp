// Motion capture: files, and the people that move by them.
#include "sim/bvh.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "lab/closed_loop/hand_speeds.hpp"
#include "sim/measured_person.hpp"
#include "sim/motions.hpp"
#include "sim/room.hpp"
#include "sim/visit.hpp"
#include "tests/closed_loop/small_motion.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using Eigen::Vector3d;

std::size_t joint_named(const sim::Bvh& motion, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(motion.joints, name, &sim::BvhJoint::name) -
                                  motion.joints.begin());
}

TEST(Bvh, TheUnitIsFoundByThePersonsHeight) {
  const TemporaryFolder folder;
  for (const double per_metre : {1.0, 100.0, 1000.0, 1 / 0.0254, 0.45 / 0.0254}) {
    const sim::Bvh motion = sim::read_bvh(folder.write("unit.bvh", small_bvh(3, 0.2, per_metre)));
    const std::vector<Pose> X_WJ = sim::joint_poses(motion, 0);
    EXPECT_NEAR(X_WJ[joint_named(motion, "head")].translation().z(), 1.5, 1e-9) << per_metre;
    EXPECT_NEAR(motion.duration_s(), 2 * kSmallFrame_s, 1e-12);
  }
}

TEST(Bvh, ChannelsTurnInTheirOrderAndBonesKeepTheirLengths) {
  const sim::Bvh motion = small_motion(3, 90);
  const std::size_t elbow = joint_named(motion, "rForeArm"), hand = joint_named(motion, "rHand");
  // By hand: 60 degrees about y turn the right forearm, along -x, towards z, the file's front.
  for (const double share : {0.0, 0.5, 1.0, 1.5}) {
    const std::vector<Pose> X_WJ = sim::joint_poses(motion, share * kSmallFrame_s);
    const double angle = (60 + 90 * share) * std::numbers::pi / 180;
    const Vector3d file_m = 0.24 * Vector3d(-std::cos(angle), 0, std::sin(angle));
    const Vector3d bone_m = X_WJ[hand].translation() - X_WJ[elbow].translation();
    EXPECT_NEAR((bone_m - Vector3d(file_m.x(), -file_m.z(), file_m.y())).norm(), 0, 1e-9) << share;
  }
}

TEST(Bvh, BrokenFilesAreRefusedWithTheirLine) {
  const std::string good = small_bvh(2, 1);
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string text = good;
    return text.replace(text.find(old), old.size(), now);
  };
  const std::vector<BadText> cases = {
      {"", {"broken.bvh:1", "the file ends", "HIERARCHY"}},
      {with("HIERARCHY", "SKELETON"), {"broken.bvh:1", "'SKELETON'", "HIERARCHY"}},
      {with("JOINT chest", "BONE chest"), {"broken.bvh:4", "'BONE'", "JOINT, End Site or }"}},
      {with("OFFSET 0 10 0", "OFFSET 0 ten 0"), {"broken.bvh:4", "'ten'", "a length"}},
      {with("CHANNELS 6", "CHANNELS 9"), {"broken.bvh:3", "'9'", "1 to 6 channels"}},
      {with("CHANNELS 3 Zrotation", "CHANNELS 3 Zposition"), {"'Zposition'", "root alone"}},
      {with("Xrotation", "Wrotation"), {"'Wrotation'", "Xrotation or the like"}},
      {with("Frames: 2", "Frames: 2000000000"), {"'2000000000'", "as the file is long"}},
      {good.substr(0, good.size() - 3), {"the file ends", "each of 2 frames", "frame 2"}},
      {with("Frames: 2", "Frames: 1"), {"'1'", "2 to"}},
      {with("Time: 0.01", "Time: 0"), {"seconds above 0"}},
      {good + "7", {"'7'", "the end after 2 frames"}},
      {with(" 60 ", " nan "), {"'nan'", "finite numbers", "frame 1"}},
      {small_bvh(2, 1, 5000), {"broken.bvh", "7.55e+03 high", "1.1 to 2.0 m"}},
  };
  const TemporaryFolder folder;
  for (const BadText& bad : cases) {
    const auto file = folder.write("broken.bvh", bad.text);
    expect_parts(error_message([&] { sim::read_bvh(file); }), bad.message_parts);
  }
}

TEST(Bvh, WhatNobodyDidIsLeftOut) {
  // 2 m/s at the hand at most, but for one frame in which it is thrown about.
  sim::Bvh motion = small_motion(400, 1);
  motion.frames[150].root_m.x() += 0.2;
  const sim::Bvh measured = sim::as_measured(motion);
  EXPECT_EQ(measured.frames.size(), 400U - 151U);
  EXPECT_EQ(measured.frames.front().root_m, motion.frames[151].root_m);
  motion.frames.resize(120);
  EXPECT_TRUE(sim::as_measured(motion).frames.empty()) << "less than a second is left";
}

TEST(Bvh, AFolderWithoutMotionsIsRefused) {
  const TemporaryFolder folder;
  expect_parts(error_message([&] { sim::read_motions(folder / "gone"); }),
               {"gone", "no such folder", "*.bvh"});
  expect_parts(error_message([&] { sim::read_motions(folder.path()); }), {"no *.bvh file"});
  folder.write("below/short.bvh", small_bvh(20, 0.2));
  expect_parts(error_message([&] { sim::read_motions(folder.path()); }), {"short.bvh", "a second"});
  folder.write("below/short.bvh", small_bvh(200, 0.2));
  EXPECT_EQ(sim::read_motions(folder.path()).size(), 1U);
  EXPECT_THROW(sim::Visit(sim::VisitKind::bvh, 1), std::invalid_argument);
}

TEST(MeasuredPerson, StandsOnTheFloorBesideTheTableAndNeverJumps) {
  // With arms to the sides the body is where the hands are: some would stand in the table.
  const std::vector<sim::Bvh> motions = {small_motion(150, 0.2, 0)};
  const sim::Box& top = sim::table_boxes().front();
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    const sim::MeasuredPerson person(motions, seed);
    const double work_s = person.duration_s() / 2;
    std::vector<Pose> before = person.pose_at(-0.5);
    double lowest_m = 1, fastest_m_s = 0;
    constexpr double kStep_s = 0.04;
    for (double t = -0.5 + kStep_s; t < person.duration_s() + 0.5; t += kStep_s) {
      const std::vector<Pose> now = person.pose_at(t);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const auto& vertices_m = person.meshes()[i].vertices_m;
        for (std::size_t k = 0; k < vertices_m.size(); k += 7) {
          const Vector3d p = vertices_m[k].cast<double>(), p_B = now[i] * p;
          fastest_m_s = std::max(fastest_m_s, (p_B - before[i] * p).norm() / kStep_s);
          if (std::abs(t - work_s) > 1.4) continue;
          lowest_m = std::min(lowest_m, p_B.z());
          const Vector3d in = (p_B - top.centre_T_m).cwiseAbs() - top.size_m / 2;
          EXPECT_TRUE(in.x() > 0 || in.y() > 0 || p_B.z() > 0) << p_B.transpose();
        }
      }
      before = now;
    }
    EXPECT_NEAR(lowest_m, sim::kFloorZ_m, 0.006);
    EXPECT_GT(fastest_m_s, 0.95);
    EXPECT_LT(fastest_m_s, 1.65);
  }
}

TEST(MeasuredPerson, LengthsAndPlacesDependOnTheSeed) {
  const std::vector<sim::Bvh> motions = {small_motion()};
  const auto forearm_m = [&](std::uint32_t seed) -> double {
    const sim::MeasuredPerson person(motions, seed);
    return person.meshes()[3].bounding_box_m().diagonal().norm();
  };
  EXPECT_EQ(forearm_m(3), forearm_m(3));
  double least_m = 9, most_m = 0;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    least_m = std::min(least_m, forearm_m(seed));
    most_m = std::max(most_m, forearm_m(seed));
  }
  EXPECT_GT(most_m / least_m, 1.1);
  EXPECT_LT(most_m / least_m, 1.1 / 0.9);
}

TEST(HandSpeeds, AreThoseOfAHandThatTurnsAboutAnElbow) {
  const double swing_deg = 3;
  const sim::Bvh motion = small_motion(50, swing_deg);
  const double expected_m_s = 0.33 * swing_deg * std::numbers::pi / 180 / kSmallFrame_s;
  const auto speeds_m_s = lab::hand_speeds_m_s(motion);
  ASSERT_EQ(speeds_m_s.size(), 2U);
  ASSERT_EQ(speeds_m_s[1].size(), 48U);
  for (const double m_s : speeds_m_s[1]) EXPECT_NEAR(m_s, expected_m_s, 0.001);
}

TEST(HandSpeeds, BurstsBeginAndEndAtTheSpeed) {
  const auto bursts = lab::bursts_above(2, {1, 3, 4, 2, 0, 5}, 0.1);
  ASSERT_EQ(bursts.size(), 2U);
  EXPECT_NEAR(bursts[0].way_m, 0.7, 1e-12);
  EXPECT_NEAR(bursts[0].beyond_m, 0.3, 1e-12);
  EXPECT_NEAR(bursts[1].way_m, 0.5, 1e-12);
}

TEST(MeasuredMotions, AreThoseOfAPersonAtWork) {
  const std::filesystem::path folder = data_folder() / "motion";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data";
  for (const sim::Bvh& motion : sim::read_motions(folder)) {
    EXPECT_GT(motion.duration_s(), 5) << motion.file;
    const std::vector<Pose> X_WJ = sim::joint_poses(motion, motion.duration_s() / 2);
    const double head_m = X_WJ[joint_named(motion, "head")].translation().z();
    EXPECT_GT(head_m, 1.1) << motion.file;
    EXPECT_LT(head_m, 1.6) << motion.file;
    for (const auto& m_s : lab::hand_speeds_m_s(motion)) {
      EXPECT_LT(*std::ranges::max_element(m_s), 6) << motion.file;
    }
  }
}

}  // namespace
}  // namespace berth
