#include "berth/pipeline/asker.hpp"

namespace berth {

Asker::Asker(const Rig& rig) : rig_(rig), renderer_(rig.meshes(), rig.camera()) {}

const Answer& Asker::ask(const Frame& frame) {
  return evaluate_robot(frame, {frame.pose, frame.X_BC, frame.robot}, frame.stamp_s);
}

const Answer& Asker::ask(const Frame& frame, const JointState& joints) {
  forward_kinematics(rig_.model(), joints.position, pose_);
  renderer_.render(pose_, frame.X_BC, robot_);
  return evaluate_robot(frame, {pose_, frame.X_BC, robot_}, joints.stamp_s);
}

const Answer& Asker::evaluate_robot(const Frame& frame, const AskedRobot& robot,
                                    double joints_stamp_s) {
  answer_.frame_stamp_s = frame.stamp_s;
  answer_.joints_stamp_s = joints_stamp_s;
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
