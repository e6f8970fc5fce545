#pragma once

#include <optional>

#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/mesh_asker.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// The controller's clock: questions about a frame, or with method `mesh` about the frames of
/// several cameras. One for each thread. Several may ask one frame, or one set of frames, at the
/// same time.
class Asker {
 public:
  /// Throws std::invalid_argument if the robot's method runs on OpenGL (GlAsker).
  explicit Asker(std::shared_ptr<const Robot> robot);

  /// The distances of the robot as it stood when the image was exposed. With the time of the
  /// question the frame's age is told and judged by EvaluationSettings::time, here and below. Valid
  /// until the next question.
  const Answer& ask(const Frame& frame, std::optional<double> now_s = {});

  /// The distances with the robot at other joint angles, now or where it is about to go, against
  /// what the frame saw; the camera stays where it was at the exposure. Valid until the next
  /// question. Throws std::invalid_argument for wrong joints.
  const Answer& ask(const Frame& frame, const JointState& joints, std::optional<double> now_s = {});

  /// The same with the buffer's newest joints. Trouble with them is a status, never an exception.
  const Answer& ask(const Frame& frame, const JointBuffer& joints, double now_s);

  /// With method `mesh`: the robot as it stood at the newest frame that is used, here and below
  /// against all frames of the set. A question costs the search alone, at any joint angles: no
  /// picture is drawn. Throws std::invalid_argument where the robot's method is another one.
  const Answer& ask(const FrameSet& frames, std::optional<double> now_s = {});
  const Answer& ask(const FrameSet& frames, const JointState& joints,
                    std::optional<double> now_s = {});
  const Answer& ask(const FrameSet& frames, const JointBuffer& joints, double now_s);

  /// Method `mesh` begins each question with what it knows of the one before. After this it knows
  /// nothing: for who times questions, or wants the same answer again to the last bit.
  void forget();

  /// The robot of the last question at other joint angles, of a method that asks images.
  const RobotImage& robot_image() const { return image_; }

 private:
  /// The first step of each question: whether the answer is in time, else it is withheld.
  bool begin(const Frame& frame, double joints_stamp_s, std::optional<double> now_s,
             const Timeliness& time);
  bool begin(const FrameSet& frames, double joints_stamp_s, const Timeliness& time);
  const Answer& evaluate_robot(const Frame& frame, const AskedRobot& robot);
  const Answer& evaluate_mesh(const FrameSet& frames, const RobotPose& pose);
  /// The set of this frame alone.
  const FrameSet& set_of(const Frame& frame);
  void require_mesh() const;
  RobotRenderer& renderer_of(const std::shared_ptr<const View>& view);

  std::shared_ptr<const Robot> robot_;
  /// Of the view that was asked last, made at the first question at other joint angles.
  std::optional<RobotRenderer> renderer_;
  std::shared_ptr<const View> rendered_view_;
  RobotPose pose_;
  RobotImage image_;
  JointState newest_;
  EvaluateWorkspace workspace_;
  TellWorkspace tell_;
  /// With method `mesh`.
  std::optional<MeshAsker> mesh_;
  FrameSet alone_;
  /// Which exposure `alone_` is of: a frame that is observed anew keeps its address.
  std::uint64_t alone_number_ = 0;
  Answer answer_;
};

}  // namespace berth
