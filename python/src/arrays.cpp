#include "arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "berth/files/depth_units.hpp"

namespace berth::python {
namespace {

constexpr double kScale_m = 0.001;

bool is_reading_or_nan(float z_m) { return (z_m > 0 && z_m < kMostReading_m) || std::isnan(z_m); }

bool are_readings_or_nan(DepthView depth_m) {
  for (int v = 0; v < depth_m.height; ++v) {
    const float* row = depth_m.row(v);
    int bad = 0;
    for (int u = 0; u < depth_m.width; ++u) bad += is_reading_or_nan(row[u]) ? 0 : 1;
    if (bad > 0) return false;
  }
  return true;
}

template <class T, class ToDepth>
void copy_rows(const py::array& array, const ToDepth& to_depth, DepthInput& out) {
  const py::array_t<T, py::array::forcecast> numbers(array);
  const auto pixels = numbers.template unchecked<2>();
  out.copy.resize(static_cast<int>(pixels.shape(1)), static_cast<int>(pixels.shape(0)), kNoDepth);
  for (int v = 0; v < out.copy.height(); ++v) {
    for (int u = 0; u < out.copy.width(); ++u) out.copy(u, v) = to_depth(pixels(v, u));
  }
  out.view = out.copy;
}

/// Whether rows of floats lie where a DepthView may look at them.
bool can_be_looked_at(const py::array& array) {
  constexpr py::ssize_t kSize = sizeof(float);
  return py::isinstance<py::array_t<float, 0>>(array) &&
         (array.shape(1) < 2 || array.strides(1) == kSize) && array.strides(0) % kSize == 0 &&
         reinterpret_cast<std::uintptr_t>(array.data()) % alignof(float) == 0;
}

}  // namespace

DepthInput depth_of(const py::object& depth, std::optional<double> scale_m) {
  if (!py::isinstance<py::array>(depth)) {
    throw py::type_error("depth: no numpy array; expected one of float32 (metres) or uint16");
  }
  const py::array array = py::reinterpret_borrow<py::array>(depth);
  if (array.ndim() != 2) {
    throw std::invalid_argument(
        fmt::format("depth: {} dimensions; expected 2, rows and columns", array.ndim()));
  }
  if (scale_m && !(*scale_m > 0 && std::isfinite(*scale_m))) {
    throw std::invalid_argument(
        fmt::format("depth_scale: {}; expected a finite number above 0", *scale_m));
  }
  DepthInput input;
  const char kind = array.dtype().kind();
  if (kind == 'u' && array.itemsize() == 2) {
    const DepthUnits units{.scale_m = scale_m.value_or(kScale_m)};
    copy_rows<std::uint16_t>(
        array, [&](std::uint16_t number) { return berth::depth_of(number, units); }, input);
    return input;
  }
  if (kind != 'f') {
    throw py::type_error("depth: numbers of type " + std::string(py::str(array.dtype())) +
                         "; expected float32 (metres) or uint16");
  }
  if (scale_m.value_or(1) == 1 && can_be_looked_at(array)) {
    const DepthView view{static_cast<const float*>(array.data()), static_cast<int>(array.shape(1)),
                         static_cast<int>(array.shape(0)),
                         array.strides(0) / static_cast<py::ssize_t>(sizeof(float))};
    if (are_readings_or_nan(view)) {
      input.kept = array;
      input.view = view;
      return input;
    }
  }
  const DepthUnits units;
  copy_rows<float>(
      array,
      [&](float z_m) {
        return reading_or_none(static_cast<double>(z_m) * scale_m.value_or(1), units);
      },
      input);
  return input;
}

Pose pose_of(const py::object& pose, const char* name) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(pose);
  if (!array || array.ndim() != 2 || array.shape(0) != 4 || array.shape(1) != 4) {
    PyErr_Clear();
    throw std::invalid_argument(
        fmt::format("{}: no matrix of 4 x 4 numbers; expected a pose", name));
  }
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) matrix(i, j) = array.at(i, j);
  }
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    throw std::invalid_argument(
        fmt::format("{}: the last row is not 0 0 0 1; expected a pose", name));
  }
  return Pose(matrix);
}

py::array_t<double> array_of(const Pose& pose) {
  py::array_t<double> array({4, 4});
  auto out = array.mutable_unchecked<2>();
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) out(i, j) = i < 3 ? pose.matrix()(i, j) : (j == 3 ? 1.0 : 0.0);
  }
  return array;
}

double joint_position_of(const std::string& name, const py::handle& position) {
  try {
    return position.cast<double>();
  } catch (const py::cast_error&) {
    throw py::type_error(fmt::format("joints: {}: {}; expected a number, in rad or m", name,
                                     std::string(py::repr(position))));
  }
}

JointState joints_of(const RobotModel& model, const py::object& joints, double stamp_s) {
  JointState state;
  state.stamp_s = stamp_s;
  if (!py::isinstance<py::dict>(joints)) {
    const auto array =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(joints);
    if (!array || array.ndim() != 1) {
      PyErr_Clear();
      throw std::invalid_argument("joints: expected a row of numbers, or a dict of them by name");
    }
    state.position.assign(array.data(), array.data() + array.size());
    return state;
  }
  const auto by_name = py::reinterpret_borrow<py::dict>(joints);
  for (const MovableJoint& joint : model.joints) {
    if (!by_name.contains(joint.name.c_str())) {
      throw std::invalid_argument(
          fmt::format("joints: {} is missing; expected a position of each joint", joint.name));
    }
    state.position.push_back(joint_position_of(joint.name, by_name[joint.name.c_str()]));
  }
  return state;
}

std::vector<JointState> many_joints_of(const RobotModel& model, const py::object& joints) {
  std::vector<JointState> states;
  if (joints.is_none()) return states;
  for (const py::handle row : joints) {
    states.push_back(joints_of(model, py::reinterpret_borrow<py::object>(row), 0));
  }
  return states;
}

py::dict dict_of(const FateCounts& counts) {
  py::dict by_name;
  for (int i = 0; i < kPixelFateCount; ++i) by_name[kPixelFateNames[i].data()] = counts[i];
  return by_name;
}

}  // namespace berth::python
