#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "berth/pipeline/asker.hpp"

namespace berth {

/// The newest frame of each camera, or null where it has none yet.
using LiveFrames = std::vector<std::shared_ptr<const Frame>>;

/// Questions about the newest frames of running cameras. It keeps the frames that it asks, sees
/// when one of them is replaced, and drops one that has become too old, so that a camera that
/// stopped takes its free space with it. One for each thread.
class LiveAsker {
 public:
  /// Throws std::invalid_argument where the robot's method runs on OpenGL, and where it is not
  /// `mesh` and there are several cameras.
  LiveAsker(std::shared_ptr<const Robot> robot, std::size_t camera_count);

  /// The robot at its newest joints, against what the cameras see. `frames` has one for each
  /// camera. Valid until the next question.
  const Answer& ask(const LiveFrames& frames, const JointBuffer& joints, double now_s);
  /// The same at any joints, now or where the robot is about to go. Without now_s the newest
  /// exposure is the time of the question, here and below. Throws std::invalid_argument for wrong
  /// joints.
  const Answer& ask(const LiveFrames& frames, const JointState& joints,
                    std::optional<double> now_s = {});
  /// The robot as it stood at the newest exposure.
  const Answer& ask_at_exposure(const LiveFrames& frames, std::optional<double> now_s = {});

  /// Camera k's part in the last answer, with methods that compare images as well.
  const std::vector<CameraState>& cameras() const { return cameras_; }
  /// The frames of the last answer.
  const LiveFrames& frames() const { return frames_; }

 private:
  bool has_mesh() const { return robot_->settings().method == Method::mesh; }
  /// Makes the set anew where a frame, or what may be done with it, has changed.
  void look(const LiveFrames& frames, double now_s);
  const Frame& only_frame() const;

  std::shared_ptr<const Robot> robot_;
  Asker asker_;
  LiveFrames frames_;
  std::vector<const Frame*> pointers_;
  std::vector<CameraState> cameras_;
  std::vector<CameraState> before_;
  FrameSet set_;
  const Frame none_;
};

}  // namespace berth
