#include "berth/reports/calibration_coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/small_calibration_data.hpp"

namespace berth {
namespace {

/// All sentences, a line each.
std::string advice_on(const testing::SmallCalibrationData& small,
                      const CalibrationCoverage& coverage, bool corrects_depth = false) {
  CalibrationReport report = small.report();
  report.corrects_depth = corrects_depth;
  std::string text;
  for (const std::string& sentence : calibration_advice(report, 0, coverage))
    text += sentence + "\n";
  return text;
}

/// Of frames that show all that there is to see.
CalibrationCoverage full_coverage(int frames = 5) {
  CalibrationCoverage coverage;
  for (int k = 0; k < frames; ++k) coverage.frames.push_back({k, 1000, 950, 940, 0.006});
  coverage.frames_with_link = {frames, frames};
  coverage.across = {0.1, 0.9};
  coverage.down = {0.1, 0.9};
  coverage.depth_m = {0.8, 1.4};
  coverage.joint_range = {1.2, 0};
  return coverage;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(CalibrationAdvice, NothingIsLeftToDoAfterAGoodCalibrationData) {
  EXPECT_EQ(advice_on(testing::SmallCalibrationData(), full_coverage()), "");
}

TEST(CalibrationAdvice, FewFramesAskForMore) {
  EXPECT_EQ(advice_on(testing::SmallCalibrationData(2), full_coverage(2)),
            "Take three more poses; go through at least 5 poses (2 used).\n");
  EXPECT_EQ(advice_on(testing::SmallCalibrationData(4), full_coverage(4)),
            "Take two more poses; go through at least 5 poses (4 used).\n");
}

TEST(CalibrationAdvice, AnUnsurePoseAsksForWhatWasNotSeen) {
  testing::SmallCalibrationData small;
  small.found().halves_m = 0.006;
  CalibrationCoverage coverage = full_coverage();
  EXPECT_EQ(advice_on(small, coverage), "Take two more poses.\n");
  coverage.across = {0.05, 0.45};
  EXPECT_EQ(
      advice_on(small, coverage),
      "Take two more poses with the arm farther to the right in the image: so far it was only "
      "seen between 5 % and 45 % of its width.\n");
  coverage.down = {0.5, 0.95};
  EXPECT_TRUE(has(advice_on(small, coverage),
                  "Take another one with the arm farther up in the image: so far it was only seen "
                  "between 50 % and 95 % of its height.\n"));
  coverage = full_coverage();
  coverage.frames_with_link = {5, 1};
  EXPECT_EQ(advice_on(small, coverage),
            "Take two more poses that show hand: only 1 of 5 frames do.\n");
  coverage.frames_with_link = {5, 0};
  EXPECT_EQ(advice_on(small, coverage), "Take two more poses.\n");
  coverage.depth_m = {1.1, 1.25};
  EXPECT_EQ(
      advice_on(small, coverage),
      "Take two more poses with the arm nearer to the camera or farther away: it was only seen "
      "from 1.10 to 1.25 m.\n");
}

TEST(CalibrationAdvice, APoseThatIsNotDeterminedAsksForMore) {
  testing::SmallCalibrationData small;
  small.found().not_determined = {"pose"};
  EXPECT_TRUE(has(advice_on(small, full_coverage()), "Take two more poses"));
}

TEST(CalibrationAdvice, AnArmThatStandsIsToldToMove) {
  testing::SmallCalibrationData small(5, 0.02);
  small.found().halves_m = 0.006;
  CalibrationCoverage coverage = full_coverage();
  coverage.joint_range = {0.08, 0};
  const std::string advice = advice_on(small, coverage);
  EXPECT_TRUE(has(advice, "no joint turned by more than 4 degrees")) << advice;
  EXPECT_FALSE(has(advice, "more poses")) << advice;
}

TEST(CalibrationAdvice, FramesThatAreNotLikeTheOthersAreNamed) {
  const testing::SmallCalibrationData small;
  CalibrationCoverage coverage = full_coverage();
  coverage.frames[1] = {11, 0, 0, 0, std::nan("")};
  coverage.frames[2] = {12, 1000, 310, 300, 0.006};
  coverage.frames[3] = {13, 1000, 950, 600, 0.006};
  coverage.frames[4] = {14, 1000, 950, 940, 0.02};
  const std::string advice = advice_on(small, coverage);
  EXPECT_TRUE(has(advice, "Frame 11 shows nothing of the robot")) << advice;
  EXPECT_TRUE(has(advice, "In frame 12 only 31 % of the robot has readings")) << advice;
  EXPECT_TRUE(has(advice, "Look at frame 13: 63 % of its readings")) << advice;
  EXPECT_TRUE(has(advice,
                  "Look at frame 14: 99 % of its readings are within 10 cm of the model, by "
                  "20.0 mm in the median."))
      << advice;
}

TEST(CalibrationAdvice, ManyFramesThatAreNotLikeTheOthersAreToldAtOnce) {
  const testing::SmallCalibrationData small;
  CalibrationCoverage coverage = full_coverage();
  for (int i = 0; i < 4; ++i) coverage.frames[i] = {10 + i, 1000, 1000, 700 + i, 0.006};
  EXPECT_EQ(advice_on(small, coverage),
            "Look at 4 of the 5 frames, 10, 11, 12, 13: 70 % of their readings at least are within "
            "10 cm of the model. If somebody stood there or the joints are not those of the "
            "images, leave them out and run again.\n");
}

TEST(CalibrationAdvice, AClockThatIsNotDeterminedAsksForMotionOrStamps) {
  testing::SmallCalibrationData small;
  small.found().not_determined = {"clock_offset_s"};
  EXPECT_TRUE(has(advice_on(small, full_coverage()), "give the images stamps"));
  small.camera.has_stamps = true;
  EXPECT_EQ(advice_on(small, full_coverage()),
            "To find the clock's offset, take images while the arm moves.\n");
}

TEST(CalibrationAdvice, DepthMattersOnlyWhereItIsCorrected) {
  testing::SmallCalibrationData small;
  small.found().not_determined = {"depth.scale"};
  EXPECT_EQ(advice_on(small, full_coverage()), "");
  EXPECT_TRUE(has(advice_on(small, full_coverage(), true), "from 0.80 to 1.40 m"));
}

TEST(CalibrationAdvice, ARefusedPoseIsCheckedOrKept) {
  testing::SmallCalibrationData small;
  small.found().refused = "it is worse";
  EXPECT_TRUE(has(advice_on(small, full_coverage()), "Keep the scene's pose"));
  small.found().score_before = 0.2;
  EXPECT_TRUE(has(advice_on(small, full_coverage()), "measure the camera's pose again"));
}

}  // namespace
}  // namespace berth
