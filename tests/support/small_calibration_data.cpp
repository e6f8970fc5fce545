#include "tests/support/small_calibration_data.hpp"

#include <cmath>
#include <limits>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::testing {
namespace {

constexpr const char* kUrdf = R"(<robot name="small">
  <link name="base"/>
  <link name="arm"><visual><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.1 0.1"/></geometry></visual></link>
  <link name="hand"><visual><origin xyz="0.1 0 0"/><geometry><box size="0.15 0.06 0.06"/></geometry></visual></link>
  <joint name="joint_1" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="joint_2" type="revolute"><parent link="arm"/><child link="hand"/><origin xyz="0.4 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";
constexpr float kWall_m = 2.5F;

/// What a camera at `X_BC` sees.
DepthImage sense(const CalibrationData& calibration_data, const Camera& camera, const Pose& X_BC,
                 const JointState& joints) {
  RobotPose pose;
  forward_kinematics(*calibration_data.model, joints.position, pose);
  RobotImage robot{DepthImage(camera.width_px, camera.height_px, kNoDepth),
                   Image<LinkId>(camera.width_px, camera.height_px, kNoLink)};
  RobotRenderer(calibration_data.meshes, camera).render(pose, X_BC, robot);
  for (float& z_m : robot.depth_m.pixels()) z_m = std::fmin(z_m, kWall_m);
  return robot.depth_m;
}

}  // namespace

SmallCalibrationData::SmallCalibrationData(int frames, double step_rad) {
  const TemporaryFolder folder;
  model = load_robot({.urdf = folder.write("small.urdf", kUrdf)});
  joints = std::make_unique<JointTrajectory>(
      model, "small.csv", std::vector<std::string>{"joint_1", "joint_2"},
      std::vector<JointTrajectory::Sample>{
          {0, {0, 0.5}}, {1, {1, 0.5}}, {2, {2, 0.5}}, {3, {3, 0.5}}});
  calibration_data = {&model, build_link_meshes(model), joints.get(), {&camera}};

  // The camera looks down on the arm from 1.5 m.
  Pose X_true = Pose::Identity();
  X_true.linear() = Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  X_true.translation() << 0.1, 0, 1.5;
  camera.name = "camera";
  camera.camera = {160, 120, 140, 140, 79.5, 59.5};
  camera.X_PC = Eigen::Translation3d(0, 0, 0.02) * X_true;
  for (int k = 0; k < frames; ++k) {
    const JointState state{0.1 * k, {step_rad * k, 0.5}};
    camera.frames.push_back({k, sense(calibration_data, camera.camera, X_true, state), state});
  }

  CameraCalibration& camera_found = result.cameras.emplace_back();
  camera_found.camera = camera.name;
  camera_found.X_PC = X_true;
  camera_found.moved_m = 0.02;
  camera_found.halves_m = 0.003;
  camera_found.before = {0.02, 0.02, 0.02};
  camera_found.after = {0, 0, 0};
  camera_found.score_before = 1.25;
  camera_found.score_after = 1.75;
  camera_found.sigma_xyz_m.setConstant(0.001);
  camera_found.sigma_rotation_rad.setConstant(0.002);
  for (int k = 0; k < frames; ++k) camera_found.frames.push_back(k);

  proposal.self_filter = {{"tolerance_m", 0.03, "Because of the tolerance."},
                          {"padding_m", 0.02, "Because of the padding."}};
  proposal.sensor = {{"speckle_px", 20, "Because of speckle."}};
  proposal.bias_m = 0.004;
  proposal.smallest = {{1, 0.004, 0.006}, {2, 0.012, std::numeric_limits<double>::quiet_NaN()}};
  proposal.rod_gap_m = 0.04;
}

}  // namespace berth::testing
