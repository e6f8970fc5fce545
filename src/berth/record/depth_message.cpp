#include "berth/record/depth_message.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "berth/files/depth_units.hpp"

namespace berth {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view kMetres = "32FC1";
constexpr std::string_view kMillimetres = "16UC1";
/// Little endian, by CDR's first version.
constexpr std::string_view kEncapsulation{"\x00\x01\x00\x00", 4};
constexpr std::size_t kAlign = 4;

void put(std::string& out, std::uint32_t value) {
  // Aligned from what follows the encapsulation, whose size is a multiple of that.
  out.resize((out.size() + kAlign - 1) / kAlign * kAlign, '\0');
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// With the zero that CDR counts to it.
void put(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size() + 1));
  out += text;
  out.push_back('\0');
}

class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  std::string_view take(std::size_t count) {
    if (at_ > bytes_.size() || count > bytes_.size() - at_) {
      throw std::runtime_error("an image's message is too short; expected all of it");
    }
    const std::string_view taken = bytes_.substr(at_, count);
    at_ += count;
    return taken;
  }
  std::uint32_t number() {
    at_ = (at_ + kAlign - 1) / kAlign * kAlign;
    std::uint32_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view text() {
    const std::string_view with_zero = take(number());
    return with_zero.substr(0, with_zero.size() - (with_zero.empty() ? 0 : 1));
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Whether each reading is one of these numbers to the last bit.
bool are_whole_millimetres(DepthView depth_m, std::vector<std::uint16_t>& numbers) {
  constexpr DepthUnits kUnits;
  numbers.clear();
  numbers.reserve(static_cast<std::size_t>(depth_m.width) * depth_m.height);
  for (int v = 0; v < depth_m.height; ++v) {
    for (int u = 0; u < depth_m.width; ++u) {
      const float reading_m = depth_m.row(v)[u];
      numbers.push_back(number_of(reading_m, kUnits.scale_m));
      const float again_m = depth_of(numbers.back(), kUnits);
      if (std::bit_cast<std::uint32_t>(again_m) != std::bit_cast<std::uint32_t>(reading_m)) {
        return false;
      }
    }
  }
  return true;
}

DepthImage image_of(std::string_view data, std::string_view encoding, int width, int height) {
  DepthImage depth_m(width, height);
  if (data.empty()) return depth_m;
  if (encoding == kMetres) {
    std::memcpy(depth_m.pixels().data(), data.data(), data.size());
    return depth_m;
  }
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    std::uint16_t number = 0;
    std::memcpy(&number, &data[i * sizeof number], sizeof number);
    depth_m.pixels()[i] = depth_of(number, DepthUnits{});
  }
  return depth_m;
}

}  // namespace

std::string_view image_definition() {
  return "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 "
         "is_bigendian\nuint32 step\nuint8[] data\n"
         "================================================================================\n"
         "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
         "================================================================================\n"
         "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
}

std::string depth_message(DepthView depth_m, double stamp_s, std::string_view frame_id) {
  constexpr double kLatest_s = 2147483647;
  const bool is_told = std::isfinite(stamp_s) && std::abs(stamp_s) < kLatest_s;
  const double whole_s = is_told ? std::floor(stamp_s) : 0;
  const double rest_ns = is_told ? (stamp_s - whole_s) * 1e9 : 0;
  std::vector<std::uint16_t> numbers;
  const bool is_whole = are_whole_millimetres(depth_m, numbers);
  const std::size_t pixel_bytes = is_whole ? sizeof(std::uint16_t) : sizeof(float);
  const std::size_t row_bytes = static_cast<std::size_t>(depth_m.width) * pixel_bytes;
  std::string out(kEncapsulation);
  out.reserve(row_bytes * static_cast<std::size_t>(depth_m.height) + 128);
  put(out, static_cast<std::uint32_t>(static_cast<std::int32_t>(whole_s)));
  put(out, static_cast<std::uint32_t>(rest_ns));
  put(out, frame_id);
  put(out, static_cast<std::uint32_t>(depth_m.height));
  put(out, static_cast<std::uint32_t>(depth_m.width));
  put(out, is_whole ? kMillimetres : kMetres);
  out.push_back('\0');  // little endian
  put(out, static_cast<std::uint32_t>(row_bytes));
  put(out, static_cast<std::uint32_t>(row_bytes * static_cast<std::size_t>(depth_m.height)));
  if (is_whole) {
    out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * pixel_bytes);
    return out;
  }
  for (int v = 0; v < depth_m.height; ++v) {
    out.append(reinterpret_cast<const char*>(depth_m.row(v)), row_bytes);
  }
  return out;
}

DepthImage depth_of_message(std::string_view bytes) {
  if (!bytes.starts_with(kEncapsulation)) {
    throw std::runtime_error("an image's message is no little endian CDR; expected that");
  }
  Fields fields(bytes);
  fields.take(kEncapsulation.size() + 8);
  fields.text();
  const std::uint32_t height = fields.number(), width = fields.number();
  const std::string_view encoding = fields.text();
  if (encoding != kMetres && encoding != kMillimetres) {
    throw std::runtime_error(
        fmt::format("encoding {}; expected {} or {}", encoding, kMetres, kMillimetres));
  }
  const std::size_t pixel_bytes = encoding == kMetres ? sizeof(float) : sizeof(std::uint16_t);
  fields.take(1);
  const std::uint32_t step = fields.number(), size = fields.number();
  const std::uint64_t row_bytes = std::uint64_t{width} * pixel_bytes;
  if (step != row_bytes || size != row_bytes * height) {
    throw std::runtime_error(fmt::format("{} x {} px in {} bytes; expected {} bytes a pixel", width,
                                         height, size, pixel_bytes));
  }
  return image_of(fields.take(size), encoding, static_cast<int>(width), static_cast<int>(height));
}

}  // namespace berth
