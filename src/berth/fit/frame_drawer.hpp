// For watch/ and calibration/: the robot of each frame, drawn where an estimate puts it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "berth/fit/calibration_data.hpp"
#include "berth/fit/posed_robot.hpp"

namespace berth {

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
