#include "berth/files/png.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "berth/files/depth_units.hpp"
#include "berth/files/error.hpp"
#include "berth/files/png_codec.hpp"

namespace berth {
namespace {

void check_scale(const std::filesystem::path& file, double depth_scale_m) {
  if (is_depth_scale(depth_scale_m)) return;
  throw_bad_file({file, 0, "depth scale"}, fmt::format("{}", depth_scale_m), kDepthScaleExpected);
}

template <typename T, typename ToNumber>
Image<std::uint16_t> numbers_of(ImageView<T> image, ToNumber to_number) {
  Image<std::uint16_t> numbers(image.width, image.height);
  for (int v = 0; v < image.height; ++v) {
    std::transform(image.row(v), image.row(v) + image.width, numbers.row(v), to_number);
  }
  return numbers;
}

}  // namespace

bool is_depth_scale(double depth_scale_m) { return depth_scale_m >= 1e-6 && depth_scale_m <= 0.1; }

DepthImage read_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                          double depth_scale_m, double near_m, double far_m, double offset_m) {
  check_scale(file, depth_scale_m);
  const Image<std::uint16_t> units = read_gray_png(file, expected_size, PngDepths::only_16_bit);
  DepthImage depth_m(units.width(), units.height());
  std::transform(units.pixels().begin(), units.pixels().end(), depth_m.pixels().begin(),
                 [rule = DepthUnits{depth_scale_m, offset_m, near_m, far_m}](std::uint16_t number) {
                   return depth_of(number, rule);
                 });
  return depth_m;
}

void check_depth_png(const std::filesystem::path& file, const Camera& expected_size,
                     double depth_scale_m) {
  check_scale(file, depth_scale_m);
  check_gray_png(file, expected_size, PngDepths::only_16_bit);
}

Image<LinkId> read_link_ids_png(const std::filesystem::path& file, const Camera& expected_size) {
  return read_gray_png(file, expected_size, PngDepths::from_8_to_16_bit);
}

void write_depth_png(const std::filesystem::path& file, DepthView depth_m, double depth_scale_m) {
  check_scale(file, depth_scale_m);
  const auto to_units = [=](float z_m) { return number_of(z_m, depth_scale_m); };
  write_gray_png(file, numbers_of(depth_m, to_units), 16);
}

void write_link_ids_png(const std::filesystem::path& file, ImageView<LinkId> link_id) {
  const Image<std::uint16_t> ids = numbers_of(link_id, [](LinkId id) { return id; });
  const bool narrow =
      std::all_of(ids.pixels().begin(), ids.pixels().end(), [](LinkId id) { return id <= 255; });
  write_gray_png(file, ids, narrow ? 8 : 16);
}

}  // namespace berth
