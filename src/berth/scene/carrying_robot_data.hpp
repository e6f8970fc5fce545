// A calibration's robot with what it carries.
#pragma once

#include "berth/calibration/attached_parts.hpp"
#include "berth/fit/calibration_data.hpp"

namespace berth {

/// Which of the parts that were found a robot carries.
enum class CarriedParts { taken, all };

/// What a calibration started from, with a robot that carries more.
class CarryingRobotData {
 public:
  /// The cameras of `bare` have to outlive it.
  CarryingRobotData(const CalibrationData& bare, const AttachedParts& parts,
                    CarriedParts which = CarriedParts::taken);
  CarryingRobotData(const CarryingRobotData&) = delete;
  CarryingRobotData& operator=(const CarryingRobotData&) = delete;

  const CalibrationData& calibration_data() const { return data_; }

 private:
  RobotModel model_;
  CalibrationData data_;
};

}  // namespace berth
