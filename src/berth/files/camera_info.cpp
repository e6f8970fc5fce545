#include "berth/files/camera_info.hpp"

#include <fmt/format.h>

#include <cmath>

#include "berth/files/read_file.hpp"
#include "berth/files/yaml_value.hpp"

namespace berth {
namespace {

// So that an image's pixels can be counted in an int.
constexpr int kLargestSize_px = 32768;

int read_size(const YamlValue& value) {
  const int size_px = value.count();
  if (size_px < 1 || size_px > kLargestSize_px) value.fail("a number of pixels from 1 to 32768");
  return size_px;
}

void check_rectified(const YamlValue& model, const YamlValue& coefficients) {
  // With all coefficients 0, a fisheye's "equidistant" still bends the image.
  if (const std::string name = model.text(); name != "plumb_bob" && name != "rational_polynomial") {
    model.fail(
        "plumb_bob or rational_polynomial; berth works on rectified images, so rectify the images "
        "of another model first");
  }
  for (const YamlValue& coefficient : coefficients.list()) {
    if (coefficient.number() != 0) {
      coefficient.fail("all zeros; berth works on rectified images, so rectify the images first");
    }
  }
}

/// In pixels: some tools write it as a part of the image's width, and some in millimetres.
double read_focal_length(const YamlValue& value, int size_px) {
  const double f_px = value.positive();
  if (f_px < 0.01 * size_px || f_px > 1000.0 * size_px) {
    value.fail(fmt::format("pixels, from {} to {}", 0.01 * size_px, 1000.0 * size_px));
  }
  return f_px;
}

/// May lie outside of an image that was cut out of a larger one.
double read_center(const YamlValue& value, int size_px) {
  const double c_px = value.number();
  if (std::abs(c_px) > 100.0 * size_px) {
    value.fail(fmt::format("pixels, from {} to {}", -100.0 * size_px, 100.0 * size_px));
  }
  return c_px;
}

/// [fx 0 cx; 0 fy cy; 0 0 1], row by row.
void read_camera_matrix(const YamlValue& data, Camera& camera) {
  data.numbers(9);
  const std::vector<YamlValue> items = data.list();
  for (const std::size_t i : {1, 3, 6, 7}) {
    if (items[i].number() != 0) items[i].fail("0 (no skew)");
  }
  if (items[8].number() != 1) items[8].fail("1");
  camera.fx_px = read_focal_length(items[0], camera.width_px);
  camera.fy_px = read_focal_length(items[4], camera.height_px);
  camera.cx_px = read_center(items[2], camera.width_px);
  camera.cy_px = read_center(items[5], camera.height_px);
}

/// `ros2 topic echo` ends each message by "---", after which YAML expects another document.
std::string without_last_separator(std::string text) {
  constexpr std::string_view kSeparator = "\n---\n";
  if (text.ends_with(kSeparator)) text.resize(text.size() - kSeparator.size() + 1);
  return text;
}

/// A sensor_msgs/CameraInfo as `ros2 topic echo` prints it, or ROS 1's `rostopic echo`.
bool is_message(const YamlMap& info) { return info.find("width") && !info.find("image_width"); }

/// ROS 2's name, or ROS 1's.
YamlValue at_either(const YamlMap& info, std::string_view name, std::string_view old_name) {
  const std::optional<YamlValue> old = info.find(old_name);
  return old ? *old : info.at(name);
}

/// The matrix is that of the whole image.
void check_whole_image(const YamlMap& info) {
  for (const char* key : {"binning_x", "binning_y"}) {
    const auto binning = info.find(key);
    if (binning && binning->count() > 1) binning->fail("0 or 1: the image as the camera took it");
  }
  const auto region = info.find("roi");
  if (!region) return;
  for (const char* key : {"x_offset", "y_offset"}) {
    const auto offset = YamlMap(*region).find(key);
    if (offset && offset->count() > 0) offset->fail("0: the whole image");
  }
}

Camera read_message(const YamlMap& info) {
  Camera camera;
  camera.width_px = read_size(info.at("width"));
  camera.height_px = read_size(info.at("height"));
  read_camera_matrix(at_either(info, "k", "K"), camera);
  const YamlValue model = info.at("distortion_model");
  check_rectified(model, at_either(info, "d", "D"));
  check_whole_image(info);
  return camera;
}

Camera read_calibration_file(const YamlMap& info) {
  Camera camera;
  camera.width_px = read_size(info.at("image_width"));
  camera.height_px = read_size(info.at("image_height"));
  read_camera_matrix(YamlMap(info.at("camera_matrix")).at("data"), camera);
  const YamlValue model = info.at("distortion_model");
  check_rectified(model, YamlMap(info.at("distortion_coefficients")).at("data"));
  return camera;
}

}  // namespace

Camera read_camera_info(const std::filesystem::path& file) {
  const YamlMap info(parse_yaml(file, without_last_separator(read_file_bytes(file))));
  return is_message(info) ? read_message(info) : read_calibration_file(info);
}

}  // namespace berth
