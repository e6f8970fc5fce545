#include "berth/pipeline/asker.hpp"

#include <stdexcept>
#include <string>

namespace berth {

Asker::Asker(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {
  const Method method = rig.settings().method;
  if (!runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " runs on OpenGL; expected one that does not");
}

const Answer& Asker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, rig_.settings().time);
  if (!begin_answer(rig_, frame.stamp_s, frame.stamp_s, time, answer_)) return answer_;
  return evaluate_robot(frame, {frame.pose, frame.X_BC, frame.robot});
}

const Answer& Asker::ask(const Frame& frame, const JointState& joints,
                         std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, rig_.settings().time);
  if (!begin_answer(rig_, frame.stamp_s, joints.stamp_s, time, answer_)) return answer_;
  forward_kinematics(rig_.model(), joints.position, pose_);
  renderer_.render(pose_, frame.X_BC, robot_);
  return evaluate_robot(frame, {pose_, frame.X_BC, robot_});
}

const Answer& Asker::ask(const Frame& frame, const JointBuffer& joints, double now_s) {
  const TimeStatus status = joints.newest(newest_);
  if (status == TimeStatus::ok) return ask(frame, newest_, now_s);
  Timeliness time = timeliness_of(frame, newest_.stamp_s, now_s, rig_.settings().time);
  time.status = status;
  begin_answer(rig_, frame.stamp_s, newest_.stamp_s, time, answer_);
  return answer_;
}

const Answer& Asker::evaluate_robot(const Frame& frame, const AskedRobot& robot) {
  evaluate(rig_.settings().method,
           {rig_.camera(), robot.image, rig_.model().link_count(), frame.searchable,
            rig_.settings().distance},
           workspace_, answer_.distances);
  tell_visibility(rig_, frame, robot, tell_, answer_);
  return answer_;
}

}  // namespace berth
