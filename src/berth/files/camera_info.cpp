#include "berth/files/camera_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "berth/files/file_bytes.hpp"
#include "berth/files/yaml_value.hpp"

namespace berth {
namespace {

// An image's pixels can be counted in an int.
constexpr int kLargestSize_px = 32768;

int read_size(const YamlValue& value) {
  const int size_px = value.count();
  if (size_px < 1 || size_px > kLargestSize_px) value.fail("a number of pixels from 1 to 32768");
  return size_px;
}

/// Lower case, without blanks, underscores and hyphens.
std::string plain_name(const YamlValue& model) {
  std::string name;
  for (const char c : model.raw_text()) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += static_cast<char>(std::tolower(c));
  }
  return name;
}

bool bends_without_coefficients(const std::string& model) {
  return std::ranges::any_of(std::array{"fisheye", "equidistant", "kannala", "omni", "mei"},
                             [&](const char* one) { return model.starts_with(one); });
}

Lens read_lens(const YamlValue& model, const YamlValue& coefficients) {
  const std::string name = plain_name(model);
  Lens lens{.is_fisheye = name == "equidistant" || name == "fisheye"};
  std::size_t known = lens.is_fisheye ? 4 : name == "rationalpolynomial" ? 8 : 5;
  if (!lens.is_fisheye && name != "plumbbob" && name != "brownconrady" && known != 8) {
    model.fail(
        "plumb_bob, rational_polynomial or equidistant: berth rectifies no images of another lens");
  }
  const std::vector<YamlValue> items = coefficients.list();
  for (std::size_t i = 0; i < items.size(); ++i) {
    const double value = items[i].number();
    if (i < known) {
      lens.coefficients[i] = value;
    } else if (value != 0) {
      items[i].fail(
          fmt::format("0: of {} berth knows the first {} coefficients", model.raw_text(), known));
    }
  }
  return lens;
}

/// None where the images are rectified, and where nothing is said of a lens.
std::optional<Lens> find_lens(const YamlMap& info, const std::optional<YamlValue>& coefficients,
                              std::optional<bool> is_rectified) {
  const std::optional<YamlValue> model = info.find("distortion_model");
  if (is_rectified == true) return {};
  if (is_rectified == false) {
    return read_lens(info.at("distortion_model"),
                     coefficients ? *coefficients : info.at("distortion_coefficients"));
  }
  constexpr const char* kChoice =
      "rectified: true for this camera if its images are rectified, or rectified: false if they "
      "are "
      "as the lens made them (berth rectifies them then)";
  if (model && bends_without_coefficients(plain_name(*model))) {
    model->fail(kChoice);
  }
  if (!coefficients) return {};
  for (const YamlValue& coefficient : coefficients->list()) {
    if (coefficient.number() != 0) coefficient.fail(fmt::format("all zeros, or {}", kChoice));
  }
  return {};
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

/// [fx 0 cx; 0 fy cy; 0 0 1], row by row, of `columns` numbers each.
void read_matrix(const YamlValue& data, std::size_t columns, Camera& camera) {
  data.numbers(3 * columns);
  const std::vector<YamlValue> items = data.list();
  for (const std::size_t i : {std::size_t{1}, columns, 2 * columns, 2 * columns + 1}) {
    if (items[i].number() != 0) items[i].fail("0 (no skew)");
  }
  if (items[2 * columns + 2].number() != 1) items[2 * columns + 2].fail("1");
  camera.fx_px = read_focal_length(items[0], camera.width_px);
  camera.fy_px = read_focal_length(items[columns + 1], camera.height_px);
  camera.cx_px = read_center(items[2], camera.width_px);
  camera.cy_px = read_center(items[columns + 2], camera.height_px);
}

/// Drivers that do not know it leave it out, or at 0.
bool is_given(const std::optional<YamlValue>& matrix) {
  if (!matrix || !matrix->is_list() || matrix->list().empty()) return false;
  return std::ranges::any_of(matrix->numbers(), [](double value) { return value != 0; });
}

/// Of rectified images P counts: where an image was rectified, K is that of the image before.
CameraInfo read_intrinsics(Camera size, const YamlValue& k, const std::optional<YamlValue>& p,
                           const std::optional<Lens>& lens) {
  if (!lens && is_given(p)) {
    read_matrix(*p, 4, size);
  } else {
    read_matrix(k, 3, size);
  }
  return {size, lens};
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
std::optional<YamlValue> find_either(const YamlMap& info, std::string_view name,
                                     std::string_view old_name) {
  const std::optional<YamlValue> old = info.find(old_name);
  return old ? old : info.find(name);
}

/// The `data` of a matrix.
std::optional<YamlValue> find_data(const YamlMap& info, std::string_view matrix) {
  const std::optional<YamlValue> map = info.find(matrix);
  return map ? YamlMap(*map).find("data") : map;
}

/// The matrix is that of the whole sensor; the image may be a part of it, its pixels gathered.
void cut_to_image(const YamlMap& info, Camera& camera) {
  int x_px = 0, y_px = 0, width_px = 0, height_px = 0, binning_x = 1, binning_y = 1;
  info.read("binning_x", &YamlValue::count, binning_x);
  info.read("binning_y", &YamlValue::count, binning_y);
  if (const auto region = info.find("roi")) {
    const YamlMap map(*region);
    map.read("x_offset", &YamlValue::count, x_px);
    map.read("y_offset", &YamlValue::count, y_px);
    map.read("width", &YamlValue::count, width_px);
    map.read("height", &YamlValue::count, height_px);
    if (x_px + width_px > camera.width_px || y_px + height_px > camera.height_px) {
      region->fail("a region of the image");
    }
  }
  const double x = std::max(1, binning_x), y = std::max(1, binning_y);
  const auto size_px = [](int part, int whole, double by) {
    return std::max(1, static_cast<int>((part > 0 ? part : whole) / by));
  };
  camera.width_px = size_px(width_px, camera.width_px, x);
  camera.height_px = size_px(height_px, camera.height_px, y);
  camera.fx_px /= x;
  camera.fy_px /= y;
  camera.cx_px = (camera.cx_px - x_px) / x;
  camera.cy_px = (camera.cy_px - y_px) / y;
}

CameraInfo read_message(const YamlMap& info, std::optional<bool> is_rectified) {
  const Camera size{read_size(info.at("width")), read_size(info.at("height")), 0, 0, 0, 0};
  const auto k = find_either(info, "k", "K");
  CameraInfo found = read_intrinsics(size, k ? *k : info.at("k"), find_either(info, "p", "P"),
                                     find_lens(info, find_either(info, "d", "D"), is_rectified));
  cut_to_image(info, found.camera);
  return found;
}

CameraInfo read_calibration_file(const YamlMap& info, std::optional<bool> is_rectified) {
  const Camera size{
      read_size(info.at("image_width")), read_size(info.at("image_height")), 0, 0, 0, 0};
  const YamlValue k = YamlMap(info.at("camera_matrix")).at("data");
  return read_intrinsics(size, k, find_data(info, "projection_matrix"),
                         find_lens(info, find_data(info, "distortion_coefficients"), is_rectified));
}

}  // namespace

CameraInfo parse_camera_info(const std::filesystem::path& name, const std::string& text,
                             std::optional<bool> is_rectified) {
  const YamlMap info(parse_yaml(name, text));
  return is_message(info) ? read_message(info, is_rectified)
                          : read_calibration_file(info, is_rectified);
}

CameraInfo read_camera_info(const std::filesystem::path& file, std::optional<bool> is_rectified) {
  return parse_camera_info(file, without_last_separator(read_file_bytes(file)), is_rectified);
}

}  // namespace berth
