// numpy arrays as images, poses and joints, and back.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth::python {

namespace py = pybind11;

/// A depth image that somebody gave, for as long as a call takes.
struct DepthInput {
  /// Holds the array that `view` looks into; or `copy` has the pixels.
  py::array kept;
  DepthImage copy;
  DepthView view;
};

/// Rows and columns of float32 (metres) or uint16 (times `scale_m`, 0.001 where there is none). An
/// array of float32 is looked at where it is, unless it has readings that are 0, negative or
/// infinite, which are none, or its columns do not lie side by side. Throws TypeError for another
/// type of number, std::invalid_argument for another number of dimensions.
DepthInput depth_of(const py::object& depth, std::optional<double> scale_m);

/// 4 x 4, or ValueError that begins with `name`.
Pose pose_of(const py::object& pose, const char* name);
py::array_t<double> array_of(const Pose& pose);

/// A position of a joint, in rad or m. Throws TypeError with its name where it is no number.
double joint_position_of(const std::string& name, const py::handle& position);

/// Positions by name, or in the robot's order. Throws std::invalid_argument where one is missing.
JointState joints_of(const RobotModel& model, const py::object& joints, double stamp_s);

/// Rows of joints, one for each of many poses; none of None.
std::vector<JointState> many_joints_of(const RobotModel& model, const py::object& joints);

/// Pixels by PixelFate.
using FateCounts = std::array<std::int64_t, kPixelFateCount>;
py::dict dict_of(const FateCounts& counts);

/// An array that looks into `data`, read only, and keeps `owner` alive. Strides in bytes.
template <class T>
py::array read_only(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                    py::handle owner) {
  py::array array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <class T>
py::array array_of(const Image<T>& image, py::handle owner) {
  using Number = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
  return read_only(reinterpret_cast<const Number*>(image.pixels().data()),
                   {image.height(), image.width()},
                   {static_cast<py::ssize_t>(sizeof(T)) * image.width(), sizeof(T)}, owner);
}

}  // namespace berth::python
