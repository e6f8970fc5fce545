#pragma once

#include <optional>

#include "berth/opengl/gl_evaluate.hpp"
#include "berth/opengl/gl_robot_renderer.hpp"
#include "berth/pipeline/answer.hpp"
#include "berth/opengl/gl_frame.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// Asker on OpenGL, for a robot whose method runs there. What comes back from the GPU is the answer;
/// with EvaluationSettings::visibility also the images, once for each question. Shaders are compiled and
/// the robot is uploaded at the first question that needs them. It belongs to the context that is
/// current when it is made, and to its thread.
class GlAsker {
 public:
  /// Throws std::invalid_argument if the robot's method does not run on OpenGL.
  explicit GlAsker(std::shared_ptr<const Robot> robot);

  /// As those of Asker.
  const Answer& ask(const GlFrame& frame, std::optional<double> now_s = {});
  const Answer& ask(const GlFrame& frame, const JointState& joints,
                    std::optional<double> now_s = {});
  /// A frame of this program's memory: its images are uploaded for the question.
  const Answer& ask(const Frame& frame, std::optional<double> now_s = {});

 private:
  void render(const RobotPose& pose, const GlFrame& frame);
  void evaluate(const GlFrame& frame, const GlRobotImage& robot);

  std::shared_ptr<const Robot> asked_robot_;
  GlEvaluator evaluator_;
  /// Of the view that was asked last, made at the first question at other joint angles than those
  /// of the exposure.
  std::optional<GlRobotRenderer> renderer_;
  std::shared_ptr<const View> rendered_view_;
  RobotPose pose_;
  GlRobotImage robot_;
  /// Read back for the visibility.
  Frame seen_;
  RobotImage asked_;
  TellWorkspace tell_;
  Answer answer_;
};

}  // namespace berth
