#include "berth/pipeline/gl_asker.hpp"

#include <stdexcept>
#include <string>

#include "berth/pipeline/timeliness.hpp"

namespace berth {

GlAsker::GlAsker(const Rig& rig) : rig_(rig) {
  const Method method = rig.settings().method;
  if (runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " does not run on OpenGL; expected one that does");
}

const Answer& GlAsker::ask(const GlFrame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, rig_.settings().time);
  if (!begin_answer(rig_, frame.stamp_s, frame.stamp_s, time, answer_)) return answer_;
  evaluate(frame, frame.robot);
  if (!rig_.settings().visibility) return answer_;
  read_back(rig_.camera(), frame, seen_);
  tell_visibility(rig_, seen_, {seen_.pose, seen_.X_BC, seen_.robot}, tell_, answer_);
  return answer_;
}

const Answer& GlAsker::ask(const GlFrame& frame, const JointState& joints,
                           std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, rig_.settings().time);
  if (!begin_answer(rig_, frame.stamp_s, joints.stamp_s, time, answer_)) return answer_;
  forward_kinematics(rig_.model(), joints.position, pose_);
  render(pose_, frame.X_BC);
  evaluate(frame, robot_);
  if (!rig_.settings().visibility) return answer_;
  read_back(rig_.camera(), frame, seen_);
  read_back(robot_, asked_);
  tell_visibility(rig_, seen_, {pose_, frame.X_BC, asked_}, tell_, answer_);
  return answer_;
}

const Answer& GlAsker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, rig_.settings().time);
  if (!begin_answer(rig_, frame.stamp_s, frame.stamp_s, time, answer_)) return answer_;
  const RigSettings& settings = rig_.settings();
  evaluator_.evaluate(settings.method,
                      {rig_.camera(), frame.robot, rig_.model().link_count(), frame.searchable,
                       settings.distance},
                      answer_.distances);
  tell_visibility(rig_, frame, {frame.pose, frame.X_BC, frame.robot}, tell_, answer_);
  return answer_;
}

void GlAsker::render(const RobotPose& pose, const Pose& X_BC) {
  if (!renderer_) {
    const Camera& camera = rig_.camera();
    renderer_.emplace(rig_.model(), camera);
    robot_ = GlRobotImage(camera.width_px, camera.height_px);
  }
  renderer_->render(pose, X_BC, robot_);
}

void GlAsker::evaluate(const GlFrame& frame, const GlRobotImage& robot) {
  const RigSettings& settings = rig_.settings();
  evaluator_.evaluate(settings.method, rig_.camera(), robot, frame.obstacles.depth_m,
                      rig_.model().link_count(), settings.distance, answer_.distances);
}

}  // namespace berth
