#include "berth/pipeline/asker.hpp"

namespace berth {

Asker::Asker(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {}

const Answer& Asker::ask(const Frame& frame, std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, now_s, rig_.settings().time);
  if (!begin(frame, frame.stamp_s, time)) return withhold();
  return evaluate_robot(frame, {frame.pose, frame.X_BC, frame.robot});
}

const Answer& Asker::ask(const Frame& frame, const JointState& joints,
                         std::optional<double> now_s) {
  const Timeliness time = timeliness_of(frame, joints.stamp_s, now_s, rig_.settings().time);
  if (!begin(frame, joints.stamp_s, time)) return withhold();
  forward_kinematics(rig_.model(), joints.position, pose_);
  renderer_.render(pose_, frame.X_BC, robot_);
  return evaluate_robot(frame, {pose_, frame.X_BC, robot_});
}

const Answer& Asker::ask(const Frame& frame, const JointBuffer& joints, double now_s) {
  const TimeStatus status = joints.newest(newest_);
  if (status == TimeStatus::ok) return ask(frame, newest_, now_s);
  Timeliness time = timeliness_of(frame, newest_.stamp_s, now_s, rig_.settings().time);
  time.status = status;
  begin(frame, newest_.stamp_s, time);
  return withhold();
}

bool Asker::begin(const Frame& frame, double joints_stamp_s, const Timeliness& time) {
  answer_.frame_stamp_s = frame.stamp_s;
  answer_.joints_stamp_s = joints_stamp_s;
  answer_.time = time;
  return time.status == TimeStatus::ok;
}

const Answer& Asker::withhold() {
  answer_.distances.pairs = 0;
  answer_.distances.links.resize(rig_.model().link_count());
  LinkId id = kNoLink;
  for (LinkDistance& link : answer_.distances.links) {
    link = {};
    link.id = ++id;
    link.status = LinkStatus::untimely;
  }
  if (!rig_.settings().visibility) return answer_;
  answer_.visibility.clear();
  for (const LinkDistance& link : answer_.distances.links) {
    answer_.visibility.emplace_back().id = link.id;
  }
  return answer_;
}

const Answer& Asker::evaluate_robot(const Frame& frame, const AskedRobot& robot) {
  evaluate(rig_.settings().method, rig_.camera(), robot.image, frame.obstacles.depth_m,
           frame.obstacle_tree, rig_.model().link_count(), rig_.settings().distance, workspace_,
           answer_.distances);
  if (rig_.settings().visibility) {
    const SeenFrame seen{rig_.camera(), frame.robot, frame.obstacles,
                         tolerance_of(rig_.settings().self_filter)};
    find_visibility(rig_.model(), rig_.sample_points(), seen, robot, answer_.distances,
                    rig_.settings().distance.range_m, visibility_, answer_.visibility);
  }
  return answer_;
}

}  // namespace berth
