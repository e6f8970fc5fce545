// Calibration on two real recordings, thinned; all of it: build/release/lab/measure_calibration.
#include <gtest/gtest.h>

#include "lab/calibration/judge.hpp"
#include "tests/calibration/found_error.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

/// Of the robot's middle before these cameras.
constexpr double kRobotDepth_m = 1.2;

class Recording : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = data_folder() / "recordings" / GetParam();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is missing";
    scene_ = read_scene(folder_ / "scene.yaml");
  }

  void expect_good(const SceneFile& start, const lab::Calibrated& calibrated) const {
    const lab::Judgement judged = lab::judge(lab::with_result(start, calibrated), folder_);
    SCOPED_TRACE(lab::text_of(judged));
    EXPECT_EQ(judged.too_far, 0);
    EXPECT_GT(judged.checked + judged.estimates, 15);
    EXPECT_GE(judged.checked_in_range, 0.9 * judged.checked);
    EXPECT_GT(judged.mask_pixels, 1000);
    // Colour image and depth image do not agree to the pixel: what is left of the masks is what
    // lies behind the robot.
    EXPECT_LE(judged.robot_pixels_left, 1);
  }

  std::filesystem::path folder_;
  SceneFile scene_;
};

TEST_P(Recording, StartsThatAreOffComeBackAndTheirSettingsAreGood) {
  const lab::Calibrated reference = lab::calibration_data(scene_);
  expect_good(scene_, reference);
  struct Start {
    double offset_m;
    double angle_deg;
    std::uint32_t seed;
  };
  for (const Start& start : {Start{0.05, 5, 41}, Start{0.05, 5, 42}, Start{0.20, 15, 43}}) {
    SCOPED_TRACE(start.seed);
    SceneFile off = scene_;
    Pose& X_PC = off.cameras[0].X_PC;
    X_PC = sim::miscalibrated(X_PC, start.offset_m, start.angle_deg * kDegree, start.seed);
    const lab::Calibrated calibrated = lab::calibration_data(off);
    EXPECT_EQ(calibrated.found.cameras[0].refused, "");
    EXPECT_LT(lab::apart_m(calibrated.found.cameras[0].X_PC, reference.found.cameras[0].X_PC,
                           kRobotDepth_m),
              0.005);
    expect_good(off, calibrated);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Recording, ::testing::Values("xarm7_realsense", "lbr_med7_zed2i"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace berth
