// What Python holds: frames and answers that stay as they are for as long as it does.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/live/live_asker.hpp"
#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/view.hpp"
#include "berth/scene/frame_result.hpp"

namespace berth::python {

/// A view with the name of its camera.
struct NamedView {
  std::shared_ptr<const View> view;
  std::string name;
};

/// A frame, and the name of its camera.
struct FrameHandle {
  std::shared_ptr<const Frame> frame;
  std::string camera;
};

/// An answer of its own, and what it takes to tell of it.
struct AnswerHandle {
  std::shared_ptr<const Robot> robot;
  Answer answer;
  /// Of each camera of the question.
  std::vector<CameraResult> cameras;
  /// As FrameResult has it.
  int frame = 0;
  std::optional<double> stamp_s = std::nullopt;

  /// It refers to this.
  FrameResult result() const;
};

/// Camera k of a question's frames.
std::vector<CameraResult> cameras_of(const std::vector<FrameHandle>& frames, const Answer& answer,
                                     const std::vector<CameraState>& states);

/// Methods that compare images tell points in their camera's frame: fills those in frame B.
void fill_base_points(const std::vector<CameraResult>& cameras, LinkDistances& distances);

/// Of robot.cpp: a JointBuffer that Python has.
bool is_buffer(const pybind11::handle& joints);
const JointBuffer& buffer_of(const pybind11::handle& joints);

}  // namespace berth::python
