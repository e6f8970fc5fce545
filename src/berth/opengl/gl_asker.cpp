#include "berth/opengl/gl_asker.hpp"

#include <stdexcept>
#include <string>

#include "berth/pipeline/timeliness.hpp"

namespace berth {

GlAsker::GlAsker(std::shared_ptr<const Robot> robot) : asked_robot_(std::move(robot)) {
  const Method method = asked_robot_->settings().method;
  if (runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " does not run on OpenGL; expected one that does");
}

const Answer& GlAsker::ask(const GlFrame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, asked_robot_->settings().time);
  if (!begin_answer(*asked_robot_, frame.stamp_s, frame.stamp_s, time, {}, answer_)) return answer_;
  evaluate(frame, frame.robot);
  if (!asked_robot_->settings().visibility) return answer_;
  read_back(frame, seen_);
  tell_visibility(*asked_robot_, seen_, {seen_.pose, seen_.X_BC, seen_.robot}, tell_, answer_);
  return answer_;
}

const Answer& GlAsker::ask(const GlFrame& frame, const JointState& joints,
                           std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, asked_robot_->settings().time);
  if (!begin_answer(*asked_robot_, frame.stamp_s, joints.stamp_s, time, {}, answer_))
    return answer_;
  forward_kinematics(asked_robot_->model(), joints.position, pose_);
  render(pose_, frame);
  evaluate(frame, robot_);
  if (!asked_robot_->settings().visibility) return answer_;
  read_back(frame, seen_);
  read_back(robot_, asked_);
  tell_visibility(*asked_robot_, seen_, {pose_, frame.X_BC, asked_}, tell_, answer_);
  return answer_;
}

const Answer& GlAsker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, asked_robot_->settings().time);
  if (!begin_answer(*asked_robot_, frame.stamp_s, frame.stamp_s, time, {}, answer_)) return answer_;
  const EvaluationSettings& settings = asked_robot_->settings();
  evaluator_.evaluate(settings.method,
                      {frame.view->camera(), frame.robot, asked_robot_->model().link_count(),
                       frame.searchable, settings.distance},
                      answer_.distances);
  tell_visibility(*asked_robot_, frame, {frame.pose, frame.X_BC, frame.robot}, tell_, answer_);
  return answer_;
}

void GlAsker::render(const RobotPose& pose, const GlFrame& frame) {
  if (rendered_view_ != frame.view) {
    rendered_view_ = frame.view;
    const Camera& camera = frame.view->camera();
    renderer_.emplace(asked_robot_->model(), camera);
    robot_ = GlRobotImage(camera.width_px, camera.height_px);
  }
  renderer_->render(pose, frame.X_BC, robot_);
}

void GlAsker::evaluate(const GlFrame& frame, const GlRobotImage& robot) {
  const EvaluationSettings& settings = asked_robot_->settings();
  evaluator_.evaluate(settings.method, frame.view->camera(), robot, frame.obstacles.depth_m,
                      asked_robot_->model().link_count(), settings.distance, answer_.distances);
}

}  // namespace berth
