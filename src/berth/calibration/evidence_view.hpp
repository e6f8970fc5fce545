// Inside calibration/ only: what each image says of places in the room, as evidence of what the
// robot carries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/fit/estimate.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {

/// What was found of one camera, about where its calibration started. `one` has that camera alone.
/// The depth's error is left out, since it is not taken out of the images by itself.
inline CalibrationEstimate found_estimate(const CalibrationData& one,
                                          const CameraCalibration& found,
                                          const CalibrationResult& all) {
  CalibrationEstimate estimate;
  CameraEstimate& camera = estimate.cameras.emplace_back();
  camera.X_PC = found.X_PC;
  camera.clock_shift_s = found.clock_offset_s - one.cameras[0]->clock_offset_s;
  for (const MovableJoint& joint : one.model->joints) {
    const auto offset = all.joint_offsets.find(joint.name);
    estimate.joint_shift.push_back(offset == all.joint_offsets.end() ? 0 : offset->second);
  }
  return estimate;
}

/// Links that no joint moves against each other. Whatever is fixed to one of them is to all.
struct RigidGroup {
  /// The one of them that a thing is said to be fixed to: of the evaluated ones, or else of all,
  /// the last in RobotModel::links.
  std::size_t link = 0;
  /// How many joints move it.
  int joints = 0;
  /// In the frame L of `link`: what surrounds their meshes by kReach_m on all sides.
  Eigen::AlignedBox3d reach_L_m;
};

/// What a link carries is looked for so far around it.
inline constexpr double kReach_m = 0.6;

/// The groups that some joint moves and that have a mesh, those before others that they move with.
/// Environment is none.
std::vector<RigidGroup> moved_groups(const RobotModel& model);

/// What a reading may show.
enum class ReadingKind : std::uint8_t {
  robot,          ///< the robot; or there is none
  beside,         ///< the self filter takes it away, though it is not at the robot's depth
  fixed,          ///< something that may always have been there
  moving_beside,  ///< as beside, at a place that another image shows free
  moving,         ///< something, at a place that another image shows free
};

/// One image of a calibration, with each step-th pixel of each step-th row.
struct EvidenceView {
  /// In CalibrationData::cameras, and CalibrationFrame::number.
  std::size_t camera_index = 0;
  int frame_number = 0;
  Camera camera;
  Pose X_BC = unset_pose();
  Pose X_CB = unset_pose();
  RobotPose pose;
  /// With the camera's depth error taken out.
  DepthImage depth_m;
  Image<ReadingKind> kind;
  /// Two images show one point of a surface up to so far apart.
  double uncertainty_m = 0;

  Eigen::Vector3d point_B_m(int u, int v) const;
};

/// Of all images whose joints are known, by cameras whose pose was found, where `found` puts robot
/// and cameras.
std::vector<EvidenceView> make_evidence_views(const CalibrationData& calibration_data,
                                              const CalibrationResult& found);

/// Whether the camera sees that nothing is there: all its readings within the uncertainty beside
/// the point lie farther behind it than that.
bool sees_free(const EvidenceView& view, const Eigen::Vector3d& p_B_m);

/// Whether the camera does not look into the point: it has no reading there, or a nearer one, which
/// is of something that may always have been there only if it is nearer by the uncertainty.
bool may_hide(const EvidenceView& view, const Eigen::Vector3d& p_B_m);

/// Whether a reading of something that moves lies within the uncertainty of the point.
bool sees_moving(const EvidenceView& view, const Eigen::Vector3d& p_B_m);

/// Tells what moves from what may be fixed, within reach of the groups: a place that never is free
/// in another image may belong to the room.
void find_moving(const std::vector<RigidGroup>& groups, std::vector<EvidenceView>& views);

}  // namespace berth
