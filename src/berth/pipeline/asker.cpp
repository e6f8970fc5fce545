#include "berth/pipeline/asker.hpp"

#include <stdexcept>
#include <string>

namespace berth {
namespace {

/// NaN where no frame is used.
double stamp_s_of(const FrameSet& frames) {
  return frames.newest() ? frames.newest()->stamp_s : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Asker::Asker(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {
  const Method method = robot_->settings().method;
  if (method == Method::mesh) mesh_.emplace(robot_);
  if (!runs_on_opengl(method)) return;
  throw std::invalid_argument("method " + std::string(name_of(method)) +
                              " runs on OpenGL; expected one that does not");
}

const Answer& Asker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, robot_->settings().time);
  if (!begin(frame, frame.stamp_s, now_s, time)) return answer_;
  if (mesh_) return evaluate_mesh(set_of(frame), frame.pose);
  return evaluate_robot(frame, {frame.pose, frame.X_BC, frame.robot});
}

const Answer& Asker::ask(const Frame& frame, const JointState& joints,
                         std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, robot_->settings().time);
  if (!begin(frame, joints.stamp_s, now_s, time)) return answer_;
  forward_kinematics(robot_->model(), joints.position, pose_);
  if (mesh_) return evaluate_mesh(set_of(frame), pose_);
  renderer_of(frame.view).render(pose_, frame.X_BC, image_);
  return evaluate_robot(frame, {pose_, frame.X_BC, image_});
}

const Answer& Asker::ask(const Frame& frame, const JointBuffer& joints, double now_s) {
  const TimeStatus status = joints.newest(newest_);
  if (status == TimeStatus::ok) return ask(frame, newest_, now_s);
  Timeliness time = timeliness_of(frame, newest_.stamp_s, now_s, robot_->settings().time);
  time.status = status;
  begin(frame, newest_.stamp_s, now_s, time);
  return answer_;
}

bool Asker::begin(const Frame& frame, double joints_stamp_s, std::optional<double> now_s,
                  const Timeliness& time) {
  const CameraState camera =
      camera_state(&frame, now_s.value_or(frame.stamp_s), robot_->settings().time);
  return begin_answer(*robot_, frame.stamp_s, joints_stamp_s, time,
                      {&camera, mesh_ ? std::size_t{1} : 0}, answer_);
}

bool Asker::begin(const FrameSet& frames, double joints_stamp_s, const Timeliness& time) {
  return begin_answer(*robot_, stamp_s_of(frames), joints_stamp_s, time, frames.cameras(), answer_);
}

void Asker::forget() {
  if (mesh_) mesh_->forget();
}

const Answer& Asker::evaluate_robot(const Frame& frame, const AskedRobot& robot) {
  evaluate(robot_->settings().method,
           {frame.view->camera(), robot.image, robot_->model().link_count(), frame.searchable,
            robot_->settings().distance},
           workspace_, answer_.distances);
  tell_visibility(*robot_, frame, robot, tell_, answer_);
  return answer_;
}

const Answer& Asker::ask(const FrameSet& frames, std::optional<double> now_s) {
  require_mesh();
  const Timeliness time = timeliness_of(frames, now_s, robot_->settings().time);
  if (!begin(frames, stamp_s_of(frames), time)) return answer_;
  return evaluate_mesh(frames, frames.newest()->pose);
}

const Answer& Asker::ask(const FrameSet& frames, const JointState& joints,
                         std::optional<double> now_s) {
  require_mesh();
  const Timeliness time = timeliness_of(frames, joints.stamp_s, now_s, robot_->settings().time);
  if (!begin(frames, joints.stamp_s, time)) return answer_;
  forward_kinematics(robot_->model(), joints.position, pose_);
  return evaluate_mesh(frames, pose_);
}

const Answer& Asker::ask(const FrameSet& frames, const JointBuffer& joints, double now_s) {
  const TimeStatus status = joints.newest(newest_);
  if (status == TimeStatus::ok) return ask(frames, newest_, now_s);
  require_mesh();
  Timeliness time = timeliness_of(frames, newest_.stamp_s, now_s, robot_->settings().time);
  time.status = status;
  begin(frames, newest_.stamp_s, time);
  return answer_;
}

const Answer& Asker::evaluate_mesh(const FrameSet& frames, const RobotPose& pose) {
  mesh_->ask(frames, pose, answer_);
  return answer_;
}

const FrameSet& Asker::set_of(const Frame& frame) {
  if (alone_.newest() == &frame && alone_number_ == frame.number) return alone_;
  const Frame* one = &frame;
  // Its age is judged at each question.
  alone_.assign({&one, 1}, robot_->settings().time);
  alone_number_ = frame.number;
  return alone_;
}

void Asker::require_mesh() const {
  if (mesh_) return;
  throw std::invalid_argument("method " + std::string(name_of(robot_->settings().method)) +
                              " looks at one frame; expected mesh for several");
}

RobotRenderer& Asker::renderer_of(const std::shared_ptr<const View>& view) {
  if (rendered_view_ == view) return *renderer_;
  rendered_view_ = view;
  return renderer_.emplace(robot_->meshes(), view->camera());
}

}  // namespace berth
