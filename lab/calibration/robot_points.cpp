#include "lab/calibration/robot_points.hpp"

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth::lab {
namespace {

/// Of what a camera sees, each so manieth pixel counts, across and down.
constexpr int kStride_px = 4;

RobotPose pose_with(const RobotModel& model, std::vector<double> joints,
                    const std::vector<double>& offsets) {
  for (std::size_t j = 0; j < joints.size(); ++j) joints[j] += offsets[j];
  RobotPose pose;
  forward_kinematics(model, joints, pose);
  return pose;
}

/// Mean distance of points between where the truth and where the result has them.
class Apart {
 public:
  Apart(const sim::DrawnCalibrationData& drawn, const Pose& X_PC_found,
        const std::vector<double>& joint_offsets)
      : drawn_(drawn), X_PC_found_(X_PC_found), joint_offsets_(joint_offsets) {}

  /// Calls take(*this) for each frame.
  template <class Take>
  double mean_m(const Take& take) {
    for (const std::vector<double>& joints : drawn_.joints_at_exposure) {
      truth_ = pose_with(model(), joints, drawn_.joint_shift);
      found_ = pose_with(model(), joints, joint_offsets_);
      X_BC_true_ = truth_.X_BL[drawn_.camera->parent] * drawn_.X_PC_true;
      X_BC_found_ = found_.X_BL[drawn_.camera->parent] * X_PC_found_;
      take();
    }
    return sum_m_ / count_;
  }

  void add(std::size_t link, const Eigen::Vector3d& p_L_m) {
    const Eigen::Vector3d true_C_m = X_BC_true_.inverse() * (truth_.X_BL[link] * p_L_m);
    const Eigen::Vector3d found_C_m = X_BC_found_.inverse() * (found_.X_BL[link] * p_L_m);
    sum_m_ += (true_C_m - found_C_m).norm();
    count_ += 1;
  }

  const RobotModel& model() const { return *drawn_.calibration_data.model; }
  const RobotPose& truth() const { return truth_; }
  const Pose& X_BC_true() const { return X_BC_true_; }

 private:
  const sim::DrawnCalibrationData& drawn_;
  const Pose X_PC_found_;
  const std::vector<double>& joint_offsets_;
  RobotPose truth_;
  RobotPose found_;
  Pose X_BC_true_;
  Pose X_BC_found_;
  double sum_m_ = 0;
  double count_ = 0;
};

}  // namespace

double robot_points_apart_m(const sim::DrawnCalibrationData& drawn, const Pose& X_PC_found,
                            const std::vector<double>& joint_offsets) {
  Apart apart(drawn, X_PC_found, joint_offsets);
  return apart.mean_m([&] {
    for (const std::size_t link : apart.model().evaluated_links) {
      const auto& vertices_m = apart.model().links[link].mesh_L.vertices_m;
      for (std::size_t i = 0; i < vertices_m.size(); i += 1 + vertices_m.size() / 200) {
        apart.add(link, vertices_m[i].cast<double>());
      }
    }
  });
}

double seen_points_apart_m(const sim::DrawnCalibrationData& drawn, const Pose& X_PC_found,
                           const std::vector<double>& joint_offsets) {
  Apart apart(drawn, X_PC_found, joint_offsets);
  const Camera& camera = drawn.camera->camera;
  RobotRenderer renderer(drawn.calibration_data.meshes, camera);
  RobotImage seen;
  return apart.mean_m([&] {
    renderer.render(apart.truth(), apart.X_BC_true(), seen);
    for (int v = 0; v < camera.height_px; v += kStride_px) {
      for (int u = 0; u < camera.width_px; u += kStride_px) {
        const LinkId id = seen.link_id(u, v);
        if (id == kNoLink || id == kEnvironmentLink) continue;
        const std::size_t link = apart.model().evaluated_links[id - 1];
        const double z_m = seen.depth_m(u, v);
        const Eigen::Vector3d p_C_m((u - camera.cx_px) / camera.fx_px * z_m,
                                    (v - camera.cy_px) / camera.fy_px * z_m, z_m);
        apart.add(link, apart.truth().X_BL[link].inverse() * (apart.X_BC_true() * p_C_m));
      }
    }
  });
}

}  // namespace berth::lab
