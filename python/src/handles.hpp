// What Python holds: results that stay as they are for as long as it does.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/robot/joint_buffer.hpp"

namespace berth::python {

/// A part of a result, or all of it, and the result, which it keeps.
template <class T>
struct Part {
  std::shared_ptr<const Result> result;
  const T* part;

  const T& operator*() const { return *part; }
  const T* operator->() const { return part; }
};

inline Part<Result> owned(Result result) {
  const auto kept = std::make_shared<const Result>(std::move(result));
  return {kept, kept.get()};
}

/// Of query.cpp: one Frame, or those of all cameras. Throws std::invalid_argument for two of a name.
std::vector<std::shared_ptr<const Frame>> frames_of(const pybind11::object& frames);

/// Of robot.cpp: a JointBuffer that Python has.
bool is_buffer(const pybind11::handle& joints);
const JointBuffer& buffer_of(const pybind11::handle& joints);

}  // namespace berth::python
