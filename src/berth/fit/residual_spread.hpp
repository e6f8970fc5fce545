#pragma once

namespace berth {

/// How far readings lie from the model's surface, along the optical axis, where they are the
/// robot's (within 10 cm). NaN where there is none.
struct ResidualSpread {
  double median_m = 0;
  double p90_m = 0;
  double p99_m = 0;
};

}  // namespace berth
