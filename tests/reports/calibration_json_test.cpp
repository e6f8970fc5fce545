#include "berth/reports/calibration_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/small_calibration_data.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

Json json_of(const testing::SmallCalibrationData& small) {
  return Json::parse(calibration_json(small.report()));
}

TEST(CalibrationJson, IsOneLineInTheOrderOfTheSchema) {
  testing::SmallCalibrationData small(2);
  small.found().not_determined = {"clock_offset_s"};
  small.result.joint_offsets = {{"joint_2", 0.004}};
  small.result.joints_not_determined = {"joint_1"};
  CalibrationReport report = small.report();
  report.warnings = {"Two \"poses\"."};
  EXPECT_EQ(
      calibration_json(report),
      R"({"schema":"berth/calibration/1","frames_used":2,"cameras":[{"camera":"camera","parent":"base",)"
      R"("xyz":[0.1,0.0,1.5],"quaternion_xyzw":[1.0,0.0,0.0,0.0],"sigma_xyz_m":[0.001,0.001,0.001],)"
      R"("sigma_rotation_rad":[0.002,0.002,0.002],"clock_offset_s":0.0,"sigma_clock_s":null,)"
      R"("depth":{"offset_m":0.0,"scale":1.0},"dilation_px":0.0,"moved_m":0.02,"halves_m":0.003,)"
      R"("residual_m":{"before":{"median":0.02,"p90":0.02,"p99":0.02},)"
      R"("after":{"median":0.0,"p90":0.0,"p99":0.0}},"score":{"before":1.25,"after":1.75},)"
      R"("not_determined":["clock_offset_s"],"refused":null,"frames":[0,1],"detection_m":null,)"
      R"("self_filter":{"tolerance_m":0.03,"padding_m":0.02},"sensor":{"speckle_px":20},"bias_m":0.004,)"
      R"("leftover_px":0,"largest_leftover_px":0,"smallest_obstacle":[)"
      R"({"depth_m":1.0,"rod_width_m":0.004,"finger_width_m":0.006},)"
      R"({"depth_m":2.0,"rod_width_m":0.012,"finger_width_m":null}],"rod_gap_m":0.04}],"detection_m":null,)"
      R"("joint_offsets":{"joint_2":0.004},"joints_not_determined":["joint_1"],)"
      R"("attached":[],"attached_refused":null,"warnings":["Two \"poses\"."]})");
}

TEST(CalibrationJson, HasWhatIsDetected) {
  testing::SmallCalibrationData small(2);
  CalibrationReport report = small.report();
  report.detection = testing::small_detection_map();
  const Json json = Json::parse(calibration_json(report));
  EXPECT_EQ(json["cameras"][0]["detection_m"], Json::parse(R"({"median":0.04,"worst":null})"));
  EXPECT_EQ(json["detection_m"],
            Json::parse(R"({"median":0.03,"worst":0.06,"worst_at_base_m":[0.2,0.0,1.0],)"
                        R"("places":4,"in_view":3,"step_m":0.1,)"
                        R"("reach":{"center_base_m":[0.0,0.0,1.0],"radius_m":0.3}})"));
  for (DetectedDiameters* one : {&report.detection.cell, &report.detection.cameras[0]}) {
    one->least_m.assign(4, std::nan(""));
  }
  EXPECT_EQ(Json::parse(calibration_json(report))["detection_m"]["worst_at_base_m"], nullptr);
}

TEST(CalibrationJson, HasWhatIsCarried) {
  testing::SmallCalibrationData small(2);
  CalibrationReport report = small.report();
  AttachedPart part;
  part.name = "hand_attached";
  part.link = "hand";
  part.size_m << 0.12, 0.08, 0.2;
  part.padding_m = 0.007;
  part.hidden_share = 0.25;
  part.places = 3;
  part.seen_in = {{0, 1}};
  part.explained_share = 0.5;
  report.attached = {{part}, "why"};
  const Json json = Json::parse(calibration_json(report));
  EXPECT_EQ(
      json["attached"][0],
      Json::parse(
          R"({"name":"hand_attached","link":"hand","size_m":[0.12,0.08,0.2],)"
          R"("padding_m":0.007,"hidden_share":0.25,"places":3,"seen_in":[{"camera":"camera","frame":1}],)"
          R"("explained_share":0.5,"triangles":0,"is_taken":false})"));
  EXPECT_EQ(json["attached_refused"], "why");
}

TEST(CalibrationJson, WhatIsNotKnownIsNull) {
  testing::SmallCalibrationData small(1);
  const double nan = std::nan("");
  small.found().halves_m = nan;
  small.found().before = {nan, nan, nan};
  const Json camera = json_of(small)["cameras"][0];
  EXPECT_TRUE(camera["halves_m"].is_null());
  EXPECT_TRUE(camera["residual_m"]["before"]["p99"].is_null());
  EXPECT_EQ(camera["residual_m"]["after"]["p99"], 0.0);
}

TEST(CalibrationJson, ARefusedPoseHasNoDeviationsAndSaysWhy) {
  testing::SmallCalibrationData small;
  EXPECT_FALSE(json_of(small)["cameras"][0]["sigma_clock_s"].is_null());
  small.found().refused = "it is worse";
  const Json camera = json_of(small)["cameras"][0];
  EXPECT_EQ(camera["refused"], "it is worse");
  for (const char* key : {"sigma_xyz_m", "sigma_rotation_rad", "sigma_clock_s"}) {
    EXPECT_TRUE(camera[key].is_null()) << key;
  }
}

TEST(CalibrationJson, NumbersAreRoundedAndTheQuaternionStaysOne) {
  testing::SmallCalibrationData small;
  small.found().X_PC.translation().x() = 1.23456789;
  small.found().X_PC.linear() =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Json camera = json_of(small)["cameras"][0];
  EXPECT_EQ(camera["xyz"][0], 1.234568);
  const std::vector<double> q = camera["quaternion_xyzw"];
  EXPECT_NEAR(std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3])), 1, 3e-9);
  EXPECT_NEAR(q[3], std::cos(0.15), 1e-9);
  small.found().X_PC.linear() = Eigen::AngleAxisd(3.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_GT(json_of(small)["cameras"][0]["quaternion_xyzw"][3], 0.1);
}

TEST(CalibrationJson, FramesOfAllCamerasAreCounted) {
  testing::SmallCalibrationData small(3);
  small.calibration_data.cameras.push_back(&small.camera);
  small.result.cameras.push_back(small.found());
  CalibrationReport report = small.report();
  report.proposals.push_back({});
  const Json json = Json::parse(calibration_json(report));
  EXPECT_EQ(json["frames_used"], 6);
  EXPECT_EQ(json["cameras"].size(), 2);
  EXPECT_EQ(json["cameras"][1]["self_filter"], Json::object());
}

}  // namespace
}  // namespace berth
