#include "berth/reports/calibration_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "berth/reports/calibration_words.hpp"
#include "tests/support/small_calibration_data.hpp"

namespace berth {
namespace {

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CalibrationTable, SaysWhatWasFoundAndHowSureThatIs) {
  testing::SmallCalibrationData small;
  small.proposal.leftover_px = 31;
  small.proposal.largest_leftover_px = 12;
  small.result.joint_offsets = {{"joint_2", 0.004}};
  small.result.joints_not_determined = {"joint_1"};
  CalibrationReport report = small.report();
  report.warnings = {"Nobody may walk there."};
  const std::string table = calibration_table(report);
  EXPECT_TRUE(table.starts_with(
      "warning: Nobody may walk there.\n"
      "camera: This camera's view of the robot was off by 20.0 mm; now it is repeatable to ± 1.5 "
      "mm "
      "(5 frames).\n"
      "  residual         before     after\n"
      "    median        20.0 mm    0.0 mm\n"
      "    90 %          20.0 mm    0.0 mm\n"
      "    99 %          20.0 mm    0.0 mm\n"
      "  fit                62 %      88 %\n"
      "  clock offset: not looked for: the images have no stamps\n"
      "  depth: the camera reads 0.0 mm too far at 1.45 m; left as it is\n"
      "  settings\n"
      "    self_filter.tolerance_m: 0.03 m\n"
      "      Because of the tolerance.\n"
      "    self_filter.padding_m: 0.02 m\n"
      "      Because of the padding.\n"
      "    sensor.speckle_px: 20 px\n"
      "      Because of speckle.\n"
      "    The camera sees the robot 4.0 mm behind its model, in the median: what lies on it and "
      "is thinner than 25.0 mm at 1 m is taken for it.\n"
      "    With these settings 31 pixels beside the robot remain in all these images, 12 of them "
      "in one piece: they would be taken for an obstacle.\n"
      "    A rod of 1 cm at the robot's side is seen from 4 cm of free space on.\n"
      "    seen 1 m away: rods of 4 mm, fingers of 6 mm\n"
      "    seen 2 m away: rods of 12 mm, fingers of not even 3 cm, or no room\n"))
      << table;
  EXPECT_TRUE(
      table.ends_with("joint offsets [rad or m]\n  joint_2: 0.0040\n  joint_1: not determined\n"))
      << table;
}

TEST(CalibrationTable, SaysWhatIsDetected) {
  testing::SmallCalibrationData small;
  CalibrationReport report = small.report();
  report.detection = testing::small_detection_map();
  EXPECT_TRUE(calibration_table(report).ends_with(
      "detection: Of the places within 0.30 m of (0.00, 0.00, 1.00), the robot's reach, 75 % are "
      "in view of some camera.\n"
      "detection: Drawn there, balls of 20 mm at 33.3 %, of 40 mm at 66.7 %, of 80 mm at 100.0 % "
      "of "
      "these are detected.\n"
      "detection: Of what is in view, 60 mm is detected everywhere; the worst place is (0.20, "
      "0.00, "
      "1.00).\n"));
  report.detection.cell.least_m[1] = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(calibration_table(report),
                   "not even 80 mm is detected everywhere; the worst "
                   "place is (0.10, 0.00, 1.00)."));
  report.detection.cell.least_m.assign(4, std::nan(""));
  EXPECT_TRUE(calibration_table(report).ends_with("0 % are in view of some camera.\n"));
}

TEST(CalibrationTable, SaysWhatIsCarriedAndWhatBecomesOfIt) {
  testing::SmallCalibrationData small;
  CalibrationReport report = small.report();
  AttachedPart part;
  part.name = "hand_attached";
  part.link = "hand";
  part.size_m << 0.12, 0.08, 0.2;
  part.hidden_share = 0.21;
  part.places = 4;
  part.seen_in = {{0, 0}, {0, 1}, {0, 2}, {0, 4}, {0, 3}};
  part.explained_share = 0.93;
  report.attached.parts = {part};
  const std::string what =
      "carried: hand carries something that its URDF does not have, 12 x 8 x 20 cm: 5 images show "
      "it, at 4 places of the room, and 93 % of the readings that come and go near the robot are "
      "its own. No image shows 21 % of its surface, where it may reach farther.\n";
  EXPECT_TRUE(calibration_table(report).ends_with(
      what +
      "  It stays an obstacle. If it is a part of the robot, calibrate with --attached "
      "yes.\n"));
  report.attached.parts[0].is_taken = true;
  EXPECT_TRUE(calibration_table(report).ends_with(
      what + "  It is a part of the robot from now on, by the name hand_attached.\n"));
  report.attached = {{}, "few poses"};
  EXPECT_TRUE(calibration_table(report).ends_with("carried: few poses\n"));
}

TEST(CalibrationTable, WhatIsNotKnownIsADash) {
  testing::SmallCalibrationData small;
  small.found().before.median_m = std::nan("");
  EXPECT_TRUE(says(calibration_table(small.report()), "    median              -    0.0 mm\n"));
}

TEST(CalibrationTable, ARefusedPoseSaysWhyAndProposesNothing) {
  testing::SmallCalibrationData small;
  small.found().refused = "the robot is elsewhere";
  small.proposal = {};
  const std::string table = calibration_table(small.report());
  EXPECT_TRUE(says(table, "The scene's pose stays: the robot is elsewhere.\n"));
  EXPECT_TRUE(says(table, "  depth: not looked for\n"));
  EXPECT_FALSE(says(table, "settings"));
}

TEST(CalibrationWords, TheHeadlineKnowsAPoseThatWasRightAndOneFrame) {
  testing::SmallCalibrationData small;
  small.found().moved_m = 0.001;
  EXPECT_EQ(headline(small.found()),
            "The scene's pose was right: what was found differs by 1.0 mm, repeatable to ± 1.5 mm "
            "(5 frames).");
  small.found().halves_m = std::nan("");
  EXPECT_EQ(headline(small.found()),
            "This camera's view of the robot was off by 1.0 mm. How well the pose repeats, "
            "one frame cannot tell.");
}

TEST(CalibrationWords, TheClockIsToldOrWhyNot) {
  testing::SmallCalibrationData small;
  small.camera.has_stamps = true;
  small.camera.clock_offset_s = 0.002;
  small.found().clock_offset_s = 0.0123;
  small.found().sigma_clock_s = 0.0004;
  EXPECT_EQ(clock_text(small.found(), small.camera), "12.3 ms, was 2.0 ms; repeatable to ± 0.4 ms");
  small.found().not_determined = {"clock_offset_s"};
  EXPECT_EQ(clock_text(small.found(), small.camera),
            "stays 2.0 ms: the arm moves too little while images are taken to tell");
}

TEST(CalibrationWords, DepthsErrorIsToldAtADistance) {
  testing::SmallCalibrationData small;
  small.found().depth = {0, 1 / 1.01};
  EXPECT_EQ(depth_text(small.found(), 1.5, true),
            "the camera reads 15.0 mm too far at 1.50 m; the new scene takes that out");
  small.found().depth = {0.01, 1};
  EXPECT_EQ(depth_text(small.found(), 1.5, false),
            "the camera reads 10.0 mm too near at 1.50 m; left as it is");
  EXPECT_EQ(depth_text(small.found(), std::nan(""), false), "unknown: no reading shows the robot");
}

TEST(CalibrationWords, OpenQuestionsAreSentences) {
  testing::SmallCalibrationData small;
  EXPECT_TRUE(open_questions(small.found()).empty());
  small.found().not_determined = {"pose", "depth.scale"};
  EXPECT_EQ(open_questions(small.found()),
            (std::vector<std::string>{"Not determined: the pose, to within 1 cm.",
                                      "Not determined: the scale of the depth's error."}));
  small.found().not_determined = {"depth.offset_m", "depth.scale"};
  EXPECT_EQ(open_questions(small.found()).size(), 1);
}

TEST(CalibrationWords, WhatIsThinnerThanTheSurfaceToleranceIsTakenForTheRobot) {
  testing::SmallCalibrationData small;
  small.proposal.bias_m = -0.01;
  small.proposal.rod_gap_m = std::nan("");
  const std::vector<std::string> sentences = consequences(small.proposal);
  EXPECT_TRUE(says(sentences[0], "10.0 mm in front of its model")) << sentences[0];
  EXPECT_TRUE(says(sentences[0], "thinner than 25.0 mm at 1 m")) << sentences[0];
  small.proposal.self_filter.push_back({"surface_tolerance_m", 0.012, ""});
  EXPECT_TRUE(says(consequences(small.proposal)[0], "thinner than 12.0 mm at 1 m"));
  EXPECT_TRUE(says(sentences[1], "nothing of the robot is left"));
  EXPECT_TRUE(says(sentences[2], "15 cm away"));
}

}  // namespace
}  // namespace berth
