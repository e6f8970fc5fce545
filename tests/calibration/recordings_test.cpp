// Teach-in on two real recordings, thinned; all of it: build/release/lab/measure_calibration.
#include <gtest/gtest.h>

#include "berth/scene/scene_teach_in.hpp"
#include "lab/calibration/judge.hpp"
#include "tests/calibration/found_error.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

struct Taught {
  CalibrationResult found;
  FilterProposal proposal;
};

Taught teach(const SceneFile& file) {
  const OpenScene scene = open_scene(file);
  const SceneTeachIn material = make_teach_in(scene);
  Taught taught{calibrate(material.teach_in), {}};
  const ViewSettings& settings = scene.cameras[0].view->settings();
  taught.proposal = propose_filter(material.teach_in, 0, taught.found, false, settings.self_filter,
                                   settings.sensor);
  return taught;
}

/// The mean over points about the robot's middle, which is 1.2 m before these cameras.
double apart_m(const Pose& a, const Pose& b) {
  const Pose X_CC = b.inverse() * a;
  double sum_m = 0;
  for (const double x : {-0.3, 0.0, 0.3}) {
    for (const double y : {-0.3, 0.0, 0.3}) {
      const Eigen::Vector3d p_C_m(x, y, 1.2);
      sum_m += (X_CC * p_C_m - p_C_m).norm();
    }
  }
  return sum_m / 9;
}

class Recording : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = data_folder() / "recordings" / GetParam();
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is missing";
    scene_ = read_scene(folder_ / "scene.yaml");
  }

  void expect_good(const SceneFile& start, const Taught& taught) const {
    const lab::Judgement judged =
        lab::judge(lab::with_result(start, taught.found, taught.proposal), folder_);
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
  const Taught reference = teach(scene_);
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
    X_PC = testing::miscalibrated(X_PC, start.offset_m, start.angle_deg * kDegree, start.seed);
    const Taught taught = teach(off);
    EXPECT_EQ(taught.found.cameras[0].refused, "");
    EXPECT_LT(apart_m(taught.found.cameras[0].X_PC, reference.found.cameras[0].X_PC), 0.005);
    expect_good(off, taught);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Recording,
                         ::testing::Values("xarm7_realsense", "lbr_med7_zed2i"),
                         [](const auto& one) { return std::string(one.param); });

}  // namespace
}  // namespace berth
