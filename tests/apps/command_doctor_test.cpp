// `berth doctor`: what is wrong with a scene, what to do next, and the exit status.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/apps/berth_program.hpp"

namespace berth {
namespace {

const std::string kBundledData = BERTH_SOURCE_DIR "/data/bundled";

/// The bundled scene's first camera with twelve of its images, and what a test changes.
struct DoctorsScene {
  double first_stamp_s = 0.013;
  /// Of the scene's images, which come each 0.1 s, each third one.
  int stride = 3;
  double period_s = 0.3;
  std::string last_image = kBundledData + "/depth/000033.png";
  std::string xyz = "[0.120, -2.250, 0.800]";
  std::string more_camera;
  std::string more;

  Outcome doctor() const {
    std::string images, stamps;
    for (int k = 0; k < 12; ++k) {
      images += k < 11 ? fmt::format("{}/depth/{:06}.png, ", kBundledData, stride * k) : last_image;
      stamps += fmt::format("{}{:.5f}", k == 0 ? "" : ", ", first_stamp_s + k * period_s);
    }
    const TemporaryFolder folder;
    folder.write(
        "scene.yaml",
        fmt::format("robot: {{urdf: {0}/arm/arm.urdf, package_paths: {{berth_arm: {0}/arm}}, "
                    "environment_links: [table]}}\ncameras:\n  - name: camera\n    info: "
                    "{0}/camera_info.yaml\n    pose: {{parent: table, xyz: {1}, quaternion_xyzw: "
                    "[-0.788699, 0.073200, -0.056410, 0.607794]}}\n    depth: [{2}]\n    stamps: "
                    "[{3}]\n{4}joints: {0}/joints.csv\n{5}",
                    kBundledData, xyz, images, stamps, more_camera, more));
    return run_berth(folder.path(), {"doctor", "scene.yaml"});
  }
};

void expect_text(const Outcome& outcome, const std::vector<std::string>& told) {
  std::size_t at = 0;
  for (const std::string& part : told) {
    const std::size_t found = outcome.out.find(part, at);
    EXPECT_NE(found, std::string::npos) << part << "\nafter\n" << outcome.out.substr(at);
    if (found != std::string::npos) at = found;
  }
}

/// Exit status 1, the part of the report that is wrong, and nothing after it but what to do next.
void expect_wrong(const Outcome& outcome, const std::string& about, const std::string& next,
                  const std::string& left_out) {
  EXPECT_EQ(outcome.exit_status, 1);
  expect_text(outcome, {"wrong   " + about, "What to do next:\n", next});
  EXPECT_EQ(outcome.err, "berth: scene.yaml: a check found it wrong, and " + left_out +
                             " after it were not run; standard output says what to do\n");
}

TEST(Doctor, AGoodSceneGetsAllChecksAndExitStatusZero) {
  const Outcome outcome = DoctorsScene{}.doctor();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.find("wrong"), std::string::npos) << outcome.out;
  expect_text(outcome,
              {"ok      files: robot berth_arm with 8 links, 12 images of 1 camera, joints",
               "ok      stamps, camera camera: 12 images, 0.013 to 3.313 s",
               "ok      place, camera camera: 100 % of the readings where the robot should be",
               "advice  no reading, camera camera: berth can miss a person in black",
               "in no image: ", " % of the ball that the robot can reach", "ok      results: 12",
               "detection, camera camera: ", "a fingertip of", "advice  watch, camera camera: off",
               "separation: the scene has none", "time, camera camera: ", " ms for a request",
               "What to do next:\n1. ", "berth calibrate scene.yaml --out calibrated.yaml"});
}

TEST(Doctor, WhatIsSaidOfSeveralCamerasInTheSameWordsIsSaidOnce) {
  const TemporaryFolder folder;
  const std::string out = run_berth(folder.path(), {"doctor", kBundledData + "/scene.yaml"}).out;
  for (const char* advice : {"no reading", "watch"}) {
    const std::string line = fmt::format("advice  {}, camera", advice);
    EXPECT_NE(out.find(line + "s camera, left, right: "), std::string::npos) << out;
    EXPECT_EQ(out.find(line), out.rfind(line)) << out;
  }
  EXPECT_NE(out.find("detection, camera left: "), std::string::npos) << "in other words";
}

TEST(Doctor, LinksThatNobodySeesAreNamedInOneAdvice) {
  DoctorsScene scene;
  scene.more = "evaluation: {min_seen_share: 0.9}\n";  // one camera never sees so much of a link
  const Outcome outcome = scene.doctor();
  expect_text(outcome, {"advice  results: no camera sees arm_link_", ", arm_link_",
                        " of 12 results", "Move or add a camera that sees arm_link_"});
  EXPECT_EQ(outcome.out.find("Move or add"), outcome.out.rfind("Move or add"));
}

TEST(Doctor, AMissingImageIsNamedAndNothingMoreIsLookedAt) {
  DoctorsScene scene;
  scene.last_image = "nowhere.png";
  const Outcome outcome = scene.doctor();
  expect_wrong(outcome, "files: ", "nowhere.png, then run berth doctor again.", "10");
  expect_text(outcome, {"nowhere.png: No such file"});
  EXPECT_EQ(outcome.out.find("stamps"), std::string::npos);
}

TEST(Doctor, StampsOfAnotherClockAreWrong) {
  DoctorsScene scene;
  scene.first_stamp_s = 2;  // the joints end at 3.7 s
  const Outcome outcome = scene.doctor();
  expect_wrong(outcome, "stamps, camera camera: ", "1. Compare the stamps of camera camera with",
               "9");
  expect_text(outcome, {"6 have no joints: these go from 0.000 to 3.700 s"});
}

TEST(Doctor, APoseThatIsMeasuredInMillimetresIsExplained) {
  DoctorsScene scene;
  scene.xyz = "[120, -2250, 800]";
  const Outcome outcome = scene.doctor();
  expect_wrong(outcome, "place, camera camera: ",
               "1. Correct camera camera in scene.yaml, then run berth "
               "doctor again: probably the pose's xyz is in millimetres.",
               "8");
  EXPECT_EQ(outcome.out.find("results"), std::string::npos);
}

TEST(Doctor, AFilterThatDetectsLessThanTheSceneSaysIsWrong) {
  DoctorsScene scene;
  scene.more = "separation: {detection_m: 0.001, no_reading: ignore}\n";
  expect_wrong(scene.doctor(), "detection, camera camera: ", "1. Write separation.detection_m: 0.0",
               "3");
}

TEST(Doctor, ADetectionThatNothingDrawnShowsIsWrongHoweverGreat) {
  DoctorsScene scene;
  scene.more_camera = "    sensor: {speckle_px: 100000}\n";
  scene.more = "separation: {detection_m: 0.1, no_reading: ignore}\n";
  expect_wrong(scene.doctor(), "detection, camera camera: ",
               "Take separation.detection_m out, or move camera camera nearer", "3");
}

TEST(Doctor, AMachineThatDoesNotKeepUpIsWrong) {
  DoctorsScene scene;
  // No machine filters 640 x 480 pixels in 20 us, and the arm stands still in that time.
  scene.period_s = 0.00002;
  scene.stride = 0;
  scene.last_image = kBundledData + "/depth/000000.png";
  const Outcome outcome = scene.doctor();
  expect_wrong(outcome, "time: ", "Give berth more or faster processors", "0");
}

TEST(Doctor, ADetectionThatNobodyHasShownGivesAdvice) {
  DoctorsScene scene;
  scene.more = "separation: {no_reading: ignore}\n";
  const Outcome outcome = scene.doctor();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.out;
  expect_text(outcome,
              {"advice  separation: nobody has shown what the cameras detect, so C is 0.85 m",
               "Run berth calibrate: it measures that, and writes separation.detection_m."});
}

}  // namespace
}  // namespace berth
