#include "berth/pipeline/asker.hpp"

#include <stdexcept>
#include <string>

namespace berth {

Asker::Asker(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {
  const Method method = robot_->settings().method;
  if (!runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " runs on OpenGL; expected one that does not");
}

const Answer& Asker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, robot_->settings().time);
  if (!begin_answer(*robot_, frame.stamp_s, frame.stamp_s, time, answer_)) return answer_;
  return evaluate_robot(frame, {frame.pose, frame.X_BC, frame.robot});
}

const Answer& Asker::ask(const Frame& frame, const JointState& joints,
                         std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, robot_->settings().time);
  if (!begin_answer(*robot_, frame.stamp_s, joints.stamp_s, time, answer_)) return answer_;
  forward_kinematics(robot_->model(), joints.position, pose_);
  renderer_of(frame.view).render(pose_, frame.X_BC, image_);
  return evaluate_robot(frame, {pose_, frame.X_BC, image_});
}

const Answer& Asker::ask(const Frame& frame, const JointBuffer& joints, double now_s) {
  const TimeStatus status = joints.newest(newest_);
  if (status == TimeStatus::ok) return ask(frame, newest_, now_s);
  Timeliness time = timeliness_of(frame, newest_.stamp_s, now_s, robot_->settings().time);
  time.status = status;
  begin_answer(*robot_, frame.stamp_s, newest_.stamp_s, time, answer_);
  return answer_;
}

const Answer& Asker::evaluate_robot(const Frame& frame, const AskedRobot& robot) {
  evaluate(robot_->settings().method,
           {frame.view->camera(), robot.image, robot_->model().link_count(), frame.searchable,
            robot_->settings().distance},
           workspace_, answer_.distances);
  tell_visibility(frame, robot, tell_, answer_);
  return answer_;
}

RobotRenderer& Asker::renderer_of(const std::shared_ptr<const View>& view) {
  if (rendered_view_ == view) return *renderer_;
  rendered_view_ = view;
  return renderer_.emplace(robot_->meshes(), view->camera());
}

}  // namespace berth
