#pragma once

#include "berth/self_filter/tolerance.hpp"
#include "berth/types/image.hpp"

namespace berth {

class Background;

/// What is known of what one camera sees, beside its image.
struct KnownPlace {
  /// The empty cell; null: nobody has learned it.
  const Background* background = nullptr;
  /// Environment's surface at each pixel that would show it if there were no robot; NaN elsewhere.
  /// Without environment of no size.
  DepthView environment_m = {};
  /// Of environment's surface.
  Tolerance tolerance = {};
  /// Whether each pixel has a reading while nothing keeps the light from the camera: wherever there
  /// is none, something may be (NoReading::hides).
  bool always_reads = false;
};

}  // namespace berth
