// For watch/ and calibration/: how well an estimate explains the images, as one number.
#pragma once

#include "berth/fit/frame_drawer.hpp"

namespace berth {

struct ScoreSettings {
  int step = 1;
  /// A reading fits the model up to this, and less the farther it is.
  double cut_m = 0.03;
  /// Of the sensor's image, for outlines; 0: depth alone, which is right for a coarse search only,
  /// since a pose that is off by a degree can have smaller depth residuals than the right one.
  int outline_reach_px = 10;
  /// Fewer pixels and places count as this number: else a pose that has all but a well-fitting
  /// corner outside of the image would be the best.
  double least_pixels = 0;
  double least_places = 0;
};

/// What a score was made of.
struct Score {
  double value = 0;
  double pixels = 0;
  double places = 0;
};

/// The mean over the robot's pixels with a reading: up to 1 where it fits, -1 where the camera sees
/// through the model, -1/4 where something stands before it. With outlines, that and the mean of
/// how well those agree are added. -2 where no frame shows the robot.
Score score(FrameDrawer& drawer, const CalibrationEstimate& estimate, const ScoreSettings& settings,
            FrameChoice choice = FrameChoice::all);

}  // namespace berth
