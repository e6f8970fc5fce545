// A scene of one camera on disk.
#pragma once

#include <fmt/format.h>

#include <string>

#include "berth/fit/calibration_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::testing {

/// cell/ with scene.yaml and all that it names but the robot, in a folder that goes with the
/// object.
class CellFolder {
 public:
  std::filesystem::path folder() const { return folder_.path(); }
  std::filesystem::path scene() const { return folder_ / "cell/scene.yaml"; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
  }

 protected:
  void write_camera_info(const Camera& c) const {
    write("cell/camera_info.yaml",
          fmt::format("image_width: {}\nimage_height: {}\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
                      "  data: [{}, 0, {}, 0, {}, {}, 0, 0, 1]\ndistortion_model: plumb_bob\n"
                      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n",
                      c.width_px, c.height_px, c.fx_px, c.cx_px, c.fy_px, c.cy_px));
  }

  /// A row for each image, at its number.
  void write_joints(const RobotModel& model, const std::vector<CalibrationFrame>& frames) const {
    std::string text = "time";
    for (const MovableJoint& joint : model.joints) text += "," + joint.name;
    text += "\n";
    for (const CalibrationFrame& frame : frames) {
      text += fmt::format("{}", frame.number);
      for (const double position : frame.joints.position) text += fmt::format(",{}", position);
      text += "\n";
    }
    write("cell/joints.csv", text);
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace berth::testing
