#include "berth/scene/scene_detection.hpp"

#include "berth/robot/kinematics.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth {
namespace {

/// More show the room again.
constexpr std::size_t kMostImages = 10;

std::vector<DetectionImage> images_of(CalibratedRobot& calibrated, const RobotModel& model,
                                      bool corrects_depth) {
  std::vector<DetectionImage> images;
  const std::vector<CalibrationFrame>& frames = calibrated.source().frames;
  const std::size_t step = (frames.size() + kMostImages - 1) / kMostImages;
  RobotPose pose;
  for (std::size_t k = 0; k < frames.size(); k += step) {
    const RobotImage* robot = calibrated.draw(k, CalibrationSide::after);
    if (!robot) continue;
    forward_kinematics(model, calibrated.joints(k, CalibrationSide::after)->position, pose);
    const Pose X_BC = pose.X_BL[calibrated.source().parent] * calibrated.found().X_PC;
    const DepthImage& depth_m = frames[k].depth_m;
    images.push_back(
        {corrects_depth ? corrected(depth_m, calibrated.found().depth) : depth_m, *robot, X_BC});
    pose_soft_bodies(model, pose, X_BC, images.back().soft);
  }
  return images;
}

}  // namespace

DetectionMap measure_detection_of(const CalibrationData& calibration_data,
                                  const CalibrationResult& found,
                                  const std::vector<FilterProposal>& filters, bool corrects_depth,
                                  const std::function<void()>& pause) {
  std::vector<DetectionCamera> cameras;
  for (std::size_t c = 0; c < filters.size(); ++c) {
    cameras.push_back({calibration_data.cameras[c]->camera,
                       filters[c].self_filter_settings,
                       filters[c].sensor_settings,
                       {}});
    CalibratedRobot calibrated(calibration_data, found, c);
    cameras.back().images = images_of(calibrated, *calibration_data.model, corrects_depth);
  }
  return measure_detection(cameras, robot_reach(*calibration_data.model), pause);
}

}  // namespace berth
