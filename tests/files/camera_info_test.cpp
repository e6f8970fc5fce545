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
  const Camera camera = read_camera_info(folder.write(
      "info.yaml", info_text(kMatrix) +
                       "camera_name: front\n"
                       "rectification_matrix: {rows: 3, cols: 3, data: [1]}\n"
                       "projection_matrix: {data: []}\nbinning_x: 0\nroi: {x_offset: 0}\n"));
  expect_the_intrinsics(camera);
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
    expect_the_intrinsics(read_camera_info(folder.write("info.yaml", text)));
  }
}

TEST(CameraInfo, RefusesAMessageOfAPartOrOfAnImageThatIsNotRectified) {
  const std::vector<BadText> table = {
      {replaced(kMessage, "- 0.0", "- 0.1"), {"info.yaml:10: d", "0.1; expected all zeros"}},
      {replaced(kMessage, "\nk:", "\nx:"), {"the key k is missing"}},
      {replaced(kMessage, "height: 540\n", ""), {"the key height is missing"}},
      {replaced(kMessage, "plumb_bob", "fisheye"), {"distortion_model: fisheye; expected plumb"}},
      {replaced(kMessage, "binning_y: 0", "binning_y: 2"), {"binning_y: 2; expected 0 or 1"}},
      {replaced(kMessage, "x_offset: 0", "x_offset: 8"), {"roi.x_offset: 8; expected 0"}},
  };
  const TemporaryFolder folder;
  for (const auto& [text, parts] : table) {
    expect_parts(error_message([&] { read_camera_info(folder.write("info.yaml", text)); }), parts);
  }
}

TEST(CameraInfo, AcceptsEveryWayToSayNoDistortion) {
  const TemporaryFolder folder;
  for (const char* none : {"[]", "[0]", "[0.0, -0.0, 0e5]", "[0, 0, 0, 0, 0, 0, 0, 0]"}) {
    for (const char* model : {"plumb_bob", "rational_polynomial"}) {
      EXPECT_EQ(read_camera_info(folder.write("info.yaml", info_text(kMatrix, none, model))).fx_px,
                534.5);
    }
  }
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
        "rectify the images first"}},
      {info_text(kMatrix, "[.nan]"),
       {"distortion_coefficients.data[0]: .nan; expected a finite number"}},
      {info_text(kMatrix, "none"), {"distortion_coefficients.data: none; expected a list"}},
      {info_text(kMatrix, "[0, 0, 0, 0]", "equidistant"),
       {"info.yaml:7: distortion_model: equidistant; expected plumb_bob or rational_polynomial",
        "rectify"}},
      {info_text(kMatrix, "[]", "pinholy"), {"distortion_model: pinholy; expected"}},
      {info_text(kMatrix, "[]", "''"), {"distortion_model: an empty text; expected"}},
      {"image_width: 960\nimage_height: 540\ncamera_matrix: {data: " + kMatrix + "}\n",
       {"the key distortion_model is missing"}},
      {"image_width: 960\nimage_height: 540\ncamera_matrix: {data: " + kMatrix +
           "}\ndistortion_model: plumb_bob\n",
       {"the key distortion_coefficients is missing"}},
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
