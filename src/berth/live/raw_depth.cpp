#include "berth/live/raw_depth.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

namespace berth {
namespace {

bool is_u16(const RawDepth& raw) { return raw.encoding == "16UC1" || raw.encoding == "mono16"; }

[[noreturn]] void fail(const std::string& what) {
  throw std::invalid_argument("depth image: " + what);
}

// Rows of messages may begin at any byte.
template <class T>
T load(const std::uint8_t* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class T, class ToDepth>
void read_rows(const RawDepth& raw, DepthImage& depth_m, const ToDepth& to_depth) {
  for (int v = 0; v < raw.height_px; ++v) {
    const std::uint8_t* from = raw.bytes.data() + v * raw.row_bytes;
    float* to = depth_m.row(v);
    for (int u = 0; u < raw.width_px; ++u) to[u] = to_depth(load<T>(from + u * sizeof(T)));
  }
}

/// What stands for a depth that was not in the message.
template <class T>
T stored(float depth_m, const DepthUnits& units) {
  const double own_m = depth_m - units.offset_m;
  if constexpr (std::is_floating_point_v<T>) {
    return std::isnan(depth_m) ? kNoDepth : static_cast<float>(own_m);
  } else {
    return number_of(static_cast<float>(own_m), units.scale_m);
  }
}

template <class T>
void write_rows(const RawDepth& raw, const ObstacleImage& obstacles, const DepthUnits& units,
                std::span<std::uint8_t> out) {
  for (int v = 0; v < raw.height_px; ++v) {
    const std::size_t begin = v * raw.row_bytes;
    for (int u = 0; u < raw.width_px; ++u) {
      const std::size_t at = begin + u * sizeof(T);
      const T value = obstacles.fate(u, v) == PixelFate::obstacle
                          ? load<T>(raw.bytes.data() + at)
                          : stored<T>(obstacles.depth_m(u, v), units);
      std::memcpy(out.data() + at, &value, sizeof value);
    }
  }
}

}  // namespace

void validate(const RawDepth& raw, const Camera& camera) {
  const bool u16 = is_u16(raw);
  if (!u16 && raw.encoding != "32FC1") {
    fail(fmt::format("encoding \"{}\"; expected 16UC1 or 32FC1", raw.encoding));
  }
  if (raw.is_bigendian) fail("big-endian numbers; expected little-endian ones");
  if (raw.width_px != camera.width_px || raw.height_px != camera.height_px) {
    fail(fmt::format("{} x {} pixels; expected the camera_info's {} x {}", raw.width_px,
                     raw.height_px, camera.width_px, camera.height_px));
  }
  const std::size_t least = raw.width_px * (u16 ? sizeof(std::uint16_t) : sizeof(float));
  if (raw.row_bytes < least) {
    fail(fmt::format("rows of {} bytes; expected at least {}", raw.row_bytes, least));
  }
  const std::size_t all = raw.row_bytes * (raw.height_px - 1) + least;
  if (raw.bytes.size() < all) {
    fail(fmt::format("{} bytes; expected at least {}", raw.bytes.size(), all));
  }
}

void read_raw_depth(const RawDepth& raw, const Camera& camera, const DepthUnits& units,
                    DepthImage& depth_m) {
  validate(raw, camera);
  if (depth_m.width() != raw.width_px || depth_m.height() != raw.height_px) {
    depth_m.resize(raw.width_px, raw.height_px, kNoDepth);
  }
  if (is_u16(raw)) {
    read_rows<std::uint16_t>(raw, depth_m,
                             [&](std::uint16_t number) { return depth_of(number, units); });
  } else {
    // An infinity or a 0 is no reading, whatever the offset.
    read_rows<float>(raw, depth_m, [&](float z_m) {
      return z_m > 0 ? reading_or_none(z_m + units.offset_m, units) : kNoDepth;
    });
  }
}

void write_raw_obstacles(const RawDepth& raw, const Camera& camera, const ObstacleImage& obstacles,
                         const DepthUnits& units, std::span<std::uint8_t> out) {
  validate(raw, camera);
  if (obstacles.fate.width() != raw.width_px || obstacles.fate.height() != raw.height_px) {
    fail(fmt::format("filtered image of {} x {} pixels; expected {} x {}", obstacles.fate.width(),
                     obstacles.fate.height(), raw.width_px, raw.height_px));
  }
  if (out.size() != raw.bytes.size()) {
    fail(fmt::format("{} bytes to write to; expected {}", out.size(), raw.bytes.size()));
  }
  if (is_u16(raw)) {
    write_rows<std::uint16_t>(raw, obstacles, units, out);
  } else {
    write_rows<float>(raw, obstacles, units, out);
  }
}

}  // namespace berth
