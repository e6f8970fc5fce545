// For watch/ and calibration/: the robot of each frame, drawn where an estimate puts it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "berth/fit/estimate.hpp"
#include "berth/robot/kinematics.hpp"

namespace berth {

/// A velocity of a rigid body in the camera's frame C: a point p_C of it moves by turn x p_C +
/// move.
struct Twist {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d move = Eigen::Vector3d::Zero();

  Eigen::Vector3d at(const Eigen::Vector3d& p_C_m) const { return turn.cross(p_C_m) + move; }
  Twist& operator+=(const Twist& other) {
    turn += other.turn;
    move += other.move;
    return *this;
  }
  Twist operator*(double factor) const { return {turn * factor, move * factor}; }
};

struct PosedRobot {
  RobotPose pose;
  Pose X_BC = unset_pose();
  /// per_joint[link][j]: of the link, as the camera sees it, for each rad or m of joint j of
  /// RobotModel::joints. Empty unless asked for.
  std::vector<std::vector<Twist>> per_joint;
  /// per_second[link]: for each second that the camera's clock is shifted. Empty unless asked for.
  std::vector<Twist> per_second;
};

struct PosedRobotRequest {
  bool per_joint = false;
  bool per_second = false;
};

/// Nothing where the shifted time lies outside of the joints' samples.
std::optional<PosedRobot> pose_robot(const CalibrationData& calibration_data, std::size_t camera,
                                     const CalibrationFrame& frame,
                                     const CalibrationEstimate& estimate,
                                     const PosedRobotRequest& request);

/// A camera's frames with each `step`-th pixel of each `step`-th row.
struct ImageLevel {
  int step = 1;
  Camera camera;
  /// One for each frame.
  std::vector<DepthImage> depth_m;
};

ImageLevel make_level(const CalibrationCamera& camera, int step);

/// Which frames of each camera take part.
enum class FrameChoice { all, even, odd };

constexpr bool is_chosen(FrameChoice choice, std::size_t frame) {
  return choice == FrameChoice::all || (frame % 2 == 0) == (choice == FrameChoice::even);
}

/// One frame with the robot in it.
struct DrawnFrame {
  /// Places in CalibrationData::cameras and CalibrationCamera::frames.
  std::size_t camera_index;
  std::size_t frame_index;
  /// Pixels of the sensor that one of these images stands for.
  int step;
  const Camera& camera;
  DepthView depth_m;
  const PosedRobot& posed;
  const RobotImage& robot;
};

/// Draws frames on all threads that TBB gives. One for each thread that asks.
class FrameDrawer {
 public:
  /// `calibration_data` has to outlive it. Frames are drawn at these steps; no others may be asked
  /// for.
  FrameDrawer(const CalibrationData& calibration_data, const std::vector<int>& steps);
  ~FrameDrawer();

  const CalibrationData& calibration_data() const { return data_; }

  /// Calls `take` for each chosen frame, from several threads at a time; frames whose joints are
  /// not known at the estimate's clock are left out.
  void draw(int step, const CalibrationEstimate& estimate, const PosedRobotRequest& request,
            FrameChoice choice, const std::function<void(const DrawnFrame&)>& take);

 private:
  struct Scratch;

  const CalibrationData& data_;
  /// By step, then by camera.
  std::map<int, std::vector<ImageLevel>> levels_;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace berth
