// What Python holds: results that stay as they are for as long as it does.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

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

/// Of robot.cpp: a JointBuffer that Python has.
bool is_buffer(const pybind11::handle& joints);
const JointBuffer& buffer_of(const pybind11::handle& joints);

}  // namespace berth::python
