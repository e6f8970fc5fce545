// Inside berth only: values and results as JSON. What is not known is null.
#pragma once

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/status.hpp"

namespace berth {

using Json = nlohmann::ordered_json;

/// The double that prints as the float does: 0.1234f becomes 0.1234, not 0.12340000271797180.
inline Json json_value(float value) {
  if (!std::isfinite(value)) return Json();
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  double same = 0;
  std::from_chars(text, end, same);
  return same;
}
inline Json json_value(double value) { return std::isfinite(value) ? Json(value) : Json(); }

inline Json json_value(const Pixel& pixel) { return pixel.u < 0 ? Json() : Json{pixel.u, pixel.v}; }

inline Json json_value(const Eigen::Vector3f& p) {
  return p.allFinite() ? Json{json_value(p.x()), json_value(p.y()), json_value(p.z())} : Json();
}

/// A camera of a stale frame says what is wrong with its time.
inline Json json_value(const CameraState& state) {
  return state.status == CameraStatus::stale ? name_of(state.time) : name_of(state.status);
}

inline Json json_value(const std::array<std::int64_t, kPixelFateCount>& counts) {
  Json json;
  for (int i = 0; i < kPixelFateCount; ++i) json[name_of(static_cast<PixelFate>(i))] = counts[i];
  return json;
}

struct Result;

/// What result_json() writes.
Json result_values(const Result& result);

}  // namespace berth
