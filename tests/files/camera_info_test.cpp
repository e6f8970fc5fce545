#include "berth/files/camera_info.hpp"

#include <gtest/gtest.h>

#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

std::string info_text(const std::string& matrix, const std::string& distortion = "[0, 0, 0, 0, 0]",
                      const std::string& model = "plumb_bob") {
  return "image_width: 960\nimage_height: 540\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: " +
         matrix + "\ndistortion_model: " + model +
         "\ndistortion_coefficients:\n  data: " + distortion + "\n";
}

const std::string kMatrix = "[534.5, 0, 478.25, 0, 530, -3, 0, 0, 1]";

void expect_the_intrinsics(const Camera& camera) {
  EXPECT_EQ(camera.width_px, 960);
  EXPECT_EQ(camera.height_px, 540);
  EXPECT_EQ(camera.fx_px, 534.5);
  EXPECT_EQ(camera.fy_px, 530);
  EXPECT_EQ(camera.cx_px, 478.25);
  EXPECT_EQ(camera.cy_px, -3);
}

TEST(CameraInfo, GivesTheIntrinsicsOfARosFile) {
  const TemporaryFolder folder;
  const CameraInfo info = read_camera_info(folder.write(
      "info.yaml", info_text(kMatrix) +
                       "camera_name: front\n"
                       "rectification_matrix: {rows: 3, cols: 3, data: [1]}\n"
                       "projection_matrix: {data: []}\nbinning_x: 0\nroi: {x_offset: 0}\n"));
  expect_the_intrinsics(info.camera);
  EXPECT_FALSE(info.lens);
}

/// As `ros2 topic echo --once` prints it.
const std::string kMessage = R"(header:
  stamp:
    sec: 3
    nanosec: 0
  frame_id: front
height: 540
width: 960
distortion_model: plumb_bob
d:
- 0.0
- 0.0
k:
- 534.5
- 0.0
- 478.25
- 0.0
- 530.0
- -3.0
- 0.0
- 0.0
- 1.0
r: [1, 0, 0, 0, 1, 0, 0, 0, 1]
binning_x: 0
binning_y: 0
roi:
  x_offset: 0
  y_offset: 0
  do_rectify: false
---
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

TEST(CameraInfo, GivesTheIntrinsicsOfARosMessage) {
  const TemporaryFolder folder;
  for (const std::string& text :
       {kMessage, replaced(replaced(kMessage, "\nk:", "\nK:"), "\nd:", "\nD:")}) {
    expect_the_intrinsics(read_camera_info(folder.write("info.yaml", text)).camera);
  }
}

CameraInfo info_of(const std::string& text, std::optional<bool> is_rectified = {}) {
  const TemporaryFolder folder;
  return read_camera_info(folder.write("info.yaml", text), is_rectified);
}

const std::string kP = "p: [500, 0, 470, 0, 0, 510, 260, 0, 0, 0, 1, 0]\n";
const std::string kNoK = replaced(
    replaced(
        replaced(replaced(replaced(kMessage, "534.5", "0.0"), "478.25", "0.0"), "530.0", "0.0"),
        "-3.0", "0.0"),
    "- 1.0", "- 0.0");

void expect_p(const Camera& camera) {
  EXPECT_EQ(camera.fx_px, 500);
  EXPECT_EQ(camera.fy_px, 510);
  EXPECT_EQ(camera.cx_px, 470);
  EXPECT_EQ(camera.cy_px, 260);
}

TEST(CameraInfo, OfRectifiedImagesPCounts) {
  const std::string with_p = replaced(kMessage, "---\n", kP);
  expect_p(info_of(with_p).camera);
  expect_p(info_of(replaced(with_p, "\np:", "\nP:")).camera);
  expect_p(info_of(replaced(kNoK, "---\n", kP)).camera);
  expect_p(
      info_of(info_text(kMatrix) + "projection_matrix: {" + replaced(kP, "p: ", "data: ") + "}\n")
          .camera);
  expect_the_intrinsics(
      info_of(replaced(kMessage, "---\n", "p: [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]\n")).camera);
  expect_parts(error_message([] { info_of(kNoK); }), {"info.yaml", "k[8]: 0.0; expected 1"});
}

TEST(CameraInfo, WhoeverHasDistortionSaysWhetherTheImagesAreRectified) {
  const std::string bent = replaced(replaced(kMessage, "- 0.0", "- 0.1"), "---\n", kP);
  expect_parts(error_message([&] { info_of(bent); }),
               {"info.yaml:10: d", "0.1; expected all zeros, or rectified: true for this camera"});
  expect_p(info_of(bent, true).camera);
  EXPECT_FALSE(info_of(bent, true).lens);
  const CameraInfo raw = info_of(bent, false);
  expect_the_intrinsics(raw.camera);
  ASSERT_TRUE(raw.lens);
  EXPECT_FALSE(raw.lens->is_fisheye);
  EXPECT_EQ(raw.lens->coefficients[0], 0.1);
  const std::string fisheye = replaced(bent, "plumb_bob", "equidistant");
  EXPECT_TRUE(info_of(fisheye, false).lens->is_fisheye);
  for (const char* model : {"equidistant", "fisheye", "kannala_brandt4"}) {
    expect_parts(error_message([&] { info_of(replaced(kMessage, "plumb_bob", model)); }),
                 {"distortion_model: " + std::string(model), "rectified: false"});
  }
}

TEST(CameraInfo, ReadsEachLensThatItCanRectify) {
  const std::string eight = "[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]";
  const auto lens = [](const std::string& coefficients, const char* model) {
    return info_of(info_text(kMatrix, coefficients, model), false).lens.value();
  };
  EXPECT_EQ(lens(eight, "rational_polynomial").coefficients[7], 0.8);
  EXPECT_EQ(lens("[0.1, 0.2, 0, 0]", "Plumb Bob").coefficients[1], 0.2);
  EXPECT_EQ(lens("[0.1, 0.2, 0, 0, 0, 0, 0, 0]", "plumb_bob").coefficients[5], 0);
  expect_parts(error_message([&] { lens(eight, "plumb_bob"); }),
               {"data[5]: 0.6; expected 0: of plumb_bob berth knows the first 5 coefficients"});
  expect_parts(error_message([&] { lens(eight, "inverse_brown_conrady"); }),
               {"inverse_brown_conrady; expected plumb_bob, rational_polynomial or equidistant"});
}

TEST(CameraInfo, CutsThePartOfTheSensorThatTheImageIs) {
  const std::string region = "x_offset: 160\n  width: 320\n  height: 240";
  const Camera part = info_of(replaced(kMessage, "x_offset: 0", region)).camera;
  EXPECT_EQ(part.width_px, 320);
  EXPECT_EQ(part.height_px, 240);
  EXPECT_EQ(part.cx_px, 318.25);
  EXPECT_EQ(part.fx_px, 534.5);
  const Camera binned =
      info_of(replaced(kMessage, "binning_x: 0\nbinning_y: 0", "binning_x: 2\nbinning_y: 2"))
          .camera;
  EXPECT_EQ(binned.width_px, 480);
  EXPECT_EQ(binned.height_px, 270);
  EXPECT_EQ(binned.fx_px, 267.25);
  EXPECT_EQ(binned.cy_px, -1.5);
  expect_parts(error_message([&] {
                 info_of(replaced(kMessage, "x_offset: 0", "x_offset: 700\n  width: 320"));
               }),
               {"roi: a map; expected a region of the image"});
}

TEST(CameraInfo, RefusesAMessageThatLacksWhatCounts) {
  const std::vector<BadText> table = {
      {replaced(kMessage, "\nk:", "\nx:"), {"the key k is missing"}},
      {replaced(kMessage, "height: 540\n", ""), {"the key height is missing"}},
  };
  for (const auto& [text, parts] : table) {
    expect_parts(error_message([&, &text = text] { info_of(text); }), parts);
  }
}

TEST(CameraInfo, AcceptsEveryWayToSayNoDistortion) {
  for (const char* none : {"[]", "[0]", "[0.0, -0.0, 0e5]", "[0, 0, 0, 0, 0, 0, 0, 0]"}) {
    for (const char* model : {"plumb_bob", "rational_polynomial", "Plumb Bob", "brown_conrady",
                              "none", "''", "pinhole"}) {
      EXPECT_EQ(info_of(info_text(kMatrix, none, model)).camera.fx_px, 534.5) << model;
    }
  }
  EXPECT_EQ(info_of("image_width: 960\nimage_height: 540\ncamera_matrix: {data: " + kMatrix + "}\n")
                .camera.fx_px,
            534.5);
}

TEST(CameraInfo, RefusesWhatIsNoRectifiedPinholeAndSaysWhere) {
  const std::string rest = "camera_matrix: {data: " + kMatrix +
                           "}\ndistortion_model: plumb_bob\ndistortion_coefficients: {data: []}\n";
  const std::vector<BadText> table = {
      {"", {"info.yaml: no YAML document; expected one"}},
      {"[1, 2]", {"info.yaml:1: a list of 2; expected a map"}},
      {"image_width: [\n", {"info.yaml:2", "expected valid YAML"}},
      {"image_height: 3\n" + rest, {"info.yaml:1: the key image_width is missing; expected"}},
      {"image_width: 3\n" + rest, {"the key image_height is missing"}},
      {"image_width: 0\nimage_height: 3\n" + rest,
       {"info.yaml:1: image_width: 0; expected", "from 1"}},
      {"image_width: 2\nimage_height: -3\n" + rest, {"info.yaml:2: image_height: -3; expected"}},
      {"image_width: 2.5\nimage_height: 3\n" + rest, {"image_width: 2.5; expected a whole number"}},
      {"image_width: 40000\nimage_height: 3\n" + rest, {"40000; expected", "to 32768"}},
      {"image_width: 2\nimage_height: 3\n", {"the key camera_matrix is missing"}},
      {"image_width: 2\nimage_height: 3\ncamera_matrix: {rows: 3}\n",
       {"info.yaml:3: camera_matrix: the key data is missing"}},
      {info_text("[1, 2, 3]"),
       {"info.yaml:6: camera_matrix.data: a list of 3; expected a list of 9 numbers"}},
      {info_text("7"), {"camera_matrix.data: 7; expected a list of 9 numbers"}},
      {info_text("[0, 0, 4, 0, 5, 6, 0, 0, 1]"),
       {"info.yaml:6: camera_matrix.data[0]: 0; expected a number above 0"}},
      {info_text("[500, 0, 4, 0, -5, 6, 0, 0, 1]"),
       {"camera_matrix.data[4]: -5; expected a number above 0"}},
      {info_text("[.nan, 0, 4, 0, 5, 6, 0, 0, 1]"),
       {"camera_matrix.data[0]: .nan; expected a finite number"}},
      {info_text("[500, 0, 4, 0, inf, 6, 0, 0, 1]"),
       {"camera_matrix.data[4]: inf; expected a finite"}},
      {info_text("[500, 0, .inf, 0, 500, 6, 0, 0, 1]"),
       {"camera_matrix.data[2]: .inf; expected a finite"}},
      {info_text("[500, 0, 4, 0, 500, nan, 0, 0, 1]"),
       {"camera_matrix.data[5]: nan; expected a finite"}},
      {info_text("[500, 0.1, 4, 0, 500, 6, 0, 0, 1]"),
       {"camera_matrix.data[1]: 0.1; expected 0 (no skew)"}},
      {info_text("[9, 0, 4, 0, 500, 6, 0, 0, 1]"),
       {"camera_matrix.data[0]: 9; expected pixels, from 9.6 to 960000"}},
      {info_text("[500, 0, 4, 0, 6e5, 6, 0, 0, 1]"),
       {"camera_matrix.data[4]: 6e5; expected pixels, from 5.4 to 540000"}},
      {info_text("[500, 0, 1e5, 0, 500, 6, 0, 0, 1]"),
       {"camera_matrix.data[2]: 1e5; expected pixels, from -96000 to 96000"}},
      {info_text("[500, 0, 4, 0, 500, -6e4, 0, 0, 1]"),
       {"camera_matrix.data[5]: -6e4; expected pixels, from -54000 to 54000"}},
      {info_text("[500, 0, 4, 1, 5, 6, 0, 0, 1]"), {"camera_matrix.data[3]: 1; expected 0"}},
      {info_text("[500, 0, 4, 0, 500, 6, 1, 0, 1]"), {"camera_matrix.data[6]: 1; expected 0"}},
      {info_text("[500, 0, 4, 0, 500, 6, 0, 2, 1]"), {"camera_matrix.data[7]: 2; expected 0"}},
      {info_text("[500, 0, 4, 0, 500, 6, 0, 0, 2]"), {"camera_matrix.data[8]: 2; expected 1"}},
      {info_text(kMatrix, "[0, 0.01]"),
       {"info.yaml:9: distortion_coefficients.data[1]: 0.01; expected all zeros",
        "rectified: false"}},
      {info_text(kMatrix, "[.nan]"),
       {"distortion_coefficients.data[0]: .nan; expected a finite number"}},
      {info_text(kMatrix, "none"), {"distortion_coefficients.data: none; expected a list"}},
      {"image_width: 2\nimage_height: 3\nimage_width: 4\n" + rest,
       {"info.yaml:3: image_width: the key stands here a second time"}},
  };
  const TemporaryFolder folder;
  for (const BadText& bad : table) {
    SCOPED_TRACE(bad.text);
    const auto file = folder.write("info.yaml", bad.text);
    expect_parts(error_message([&] { read_camera_info(file); }), bad.message_parts);
  }
  expect_parts(error_message([&] { read_camera_info(folder / "none.yaml"); }),
               {"none.yaml: No such file", "expected"});
}

}  // namespace
}  // namespace berth
