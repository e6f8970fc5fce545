#include "berth/robot/point_jacobian.hpp"

namespace berth {

void point_jacobian(const RobotModel& model, const RobotPose& pose, std::size_t link,
                    const Eigen::Vector3d& p_B_m, Eigen::Matrix3Xd& jacobian) {
  jacobian.setZero(3, static_cast<Eigen::Index>(model.joints.size()));
  for (std::optional<std::size_t> i = link; i; i = model.links[*i].parent) {
    const Joint& joint = model.links[*i].joint;
    if (!joint.position_index) continue;
    const Pose& X_BL = pose.X_BL[*i];
    const Eigen::Vector3d axis_B = joint.multiplier * (X_BL.linear() * joint.axis_J);
    const bool slides = joint.type == JointType::prismatic;
    jacobian.col(static_cast<Eigen::Index>(*joint.position_index)) +=
        slides ? axis_B : Eigen::Vector3d(axis_B.cross(p_B_m - X_BL.translation()));
  }
}

}  // namespace berth
