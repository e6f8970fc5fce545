#include "berth/scene/calibrated_robot.hpp"

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/joints_at_time.hpp"

namespace berth {

CalibratedRobot::CalibratedRobot(const CalibrationData& calibration_data,
                                 const CalibrationResult& result, std::size_t camera)
    : data_(calibration_data),
      result_(result),
      camera_(camera),
      renderer_(calibration_data.meshes, calibration_data.cameras[camera]->camera) {
  const Camera& size = source().camera;
  image_.depth_m.resize(size.width_px, size.height_px, kNoDepth);
  image_.link_id.resize(size.width_px, size.height_px, kNoLink);
}

const RobotImage* CalibratedRobot::draw(std::size_t frame, CalibrationSide side) {
  const std::optional<JointState> at = joints(frame, side);
  if (!at) return nullptr;
  forward_kinematics(*data_.model, at->position, pose_);
  const Pose& X_PC = side == CalibrationSide::before ? source().X_PC : found().X_PC;
  renderer_.render(pose_, pose_.X_BL[source().parent] * X_PC, image_);
  return &image_;
}

DepthImage CalibratedRobot::residual_m(std::size_t frame, CalibrationSide side,
                                       const RobotImage& robot) const {
  const DepthImage& reading_m = source().frames[frame].depth_m;
  const DepthError error = side == CalibrationSide::before ? DepthError{} : found().depth;
  DepthImage residual_m(reading_m.width(), reading_m.height(), kNoDepth);
  for (std::size_t i = 0; i < reading_m.pixels().size(); ++i) {
    if (!is_robot(robot.link_id.pixels()[i])) continue;
    const double z_m = error.offset_m + error.scale * reading_m.pixels()[i];
    residual_m.pixels()[i] = static_cast<float>(z_m - robot.depth_m.pixels()[i]);
  }
  return residual_m;
}

std::optional<JointState> CalibratedRobot::joints(std::size_t frame, CalibrationSide side) const {
  JointState joints = source().frames[frame].joints;
  if (side == CalibrationSide::before) return joints;
  if (data_.joints && found().clock_offset_s != source().clock_offset_s) {
    const double time_s = joints.stamp_s + found().clock_offset_s;
    if (data_.joints->at(time_s, kOnlyBetweenSamples, joints).status != TimeStatus::ok) {
      return std::nullopt;
    }
  }
  for (std::size_t j = 0; j < joints.position.size(); ++j) {
    const auto offset = result_.joint_offsets.find(data_.model->joints[j].name);
    if (offset != result_.joint_offsets.end()) joints.position[j] += offset->second;
  }
  return joints;
}

CarryingRobotData::CarryingRobotData(const CalibrationData& bare, const AttachedParts& parts,
                                     CarriedParts which)
    : model_(*bare.model), data_(bare) {
  for (const AttachedPart& part : parts.parts) {
    if (part.is_taken || which == CarriedParts::all) {
      model_ = with_attachment(model_, attachment_of(part));
    }
  }
  data_.model = &model_;
  if (model_.links.size() > bare.model->links.size()) data_.meshes = build_link_meshes(model_);
}

}  // namespace berth
