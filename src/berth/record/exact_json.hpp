// Inside record/ only: JSON from which every number comes back to the last bit.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

using Json = nlohmann::ordered_json;

/// JSON knows no NaN and no infinity: they are strings.
inline Json exact(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

inline Json exact(std::span<const double> values) {
  Json all = Json::array();
  for (const double value : values) all.push_back(exact(value));
  return all;
}

/// The upper three rows, one after another.
inline Json exact(const Pose& X) {
  Json all = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) all.push_back(exact(X.matrix()(row, column)));
  }
  return all;
}

inline Json exact(const JointState& joints) {
  return {{"stamp_s", exact(joints.stamp_s)}, {"position", exact(joints.position)}};
}

/// A value of a recording's JSON. Each throws nlohmann::json::exception, or std::runtime_error with
/// the key, where it is of another kind.
inline double number_of(const Json& value) {
  if (!value.is_string()) return value.get<double>();
  const auto& text = value.get_ref<const std::string&>();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return kInfinity;
  if (text == "-inf") return -kInfinity;
  throw std::runtime_error("\"" + text + "\"; expected a number");
}

inline std::vector<double> numbers_of(const Json& value) {
  std::vector<double> all;
  for (const Json& one : value) all.push_back(number_of(one));
  return all;
}

inline Pose pose_of(const Json& value) {
  const std::vector<double> numbers = numbers_of(value);
  if (numbers.size() != 12) throw std::runtime_error("a pose; expected 12 numbers");
  Pose X = Pose::Identity();
  for (Eigen::Index i = 0; i < 12; ++i) {
    X.matrix()(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
  }
  return X;
}

inline JointState joints_of(const Json& value) {
  return {number_of(value.at("stamp_s")), numbers_of(value.at("position"))};
}

/// The enumerator of this name, of `count` in all.
template <class Enum>
Enum enum_of(const Json& value, std::size_t count) {
  const auto& name = value.get_ref<const std::string&>();
  for (std::size_t i = 0; i < count; ++i) {
    if (name_of(static_cast<Enum>(i)) == name) return static_cast<Enum>(i);
  }
  throw std::runtime_error("\"" + name + "\"; expected a name that this version of berth knows");
}

}  // namespace berth
