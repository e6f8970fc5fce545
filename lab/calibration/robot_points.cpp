#include "lab/calibration/robot_points.hpp"

#include "berth/robot/kinematics.hpp"

namespace berth::lab {
namespace {

RobotPose pose_with(const RobotModel& model, std::vector<double> joints,
                    const std::vector<double>& offsets) {
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j] += offsets[j];
  RobotPose pose;
  forward_kinematics(model, joints, pose);
  return pose;
}

}  // namespace

double robot_points_apart_m(const testing::DrawnTeachIn& drawn, const Pose& X_PC_found,
                            const std::vector<double>& joint_offsets) {
  const RobotModel& model = *drawn.teach_in.model;
  double sum_m = 0;
  double count = 0;
  for (const std::vector<double>& joints : drawn.joints_at_exposure) {
    const RobotPose truth = pose_with(model, joints, drawn.joint_shift);
    const RobotPose found = pose_with(model, joints, joint_offsets);
    for (const std::size_t link : model.evaluated_links) {
      const auto& vertices_m = model.links[link].mesh_L.vertices_m;
      const Pose X_CL_true = drawn.X_PC_true.inverse() * truth.X_BL[link];
      const Pose X_CL_found = X_PC_found.inverse() * found.X_BL[link];
      for (std::size_t i = 0; i < vertices_m.size(); i += 1 + vertices_m.size() / 200) {
        const Eigen::Vector3d p_L_m = vertices_m[i].cast<double>();
        sum_m += (X_CL_true * p_L_m - X_CL_found * p_L_m).norm();
        count += 1;
      }
    }
  }
  return sum_m / count;
}

}  // namespace berth::lab
