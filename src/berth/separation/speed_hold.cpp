#include "berth/separation/speed_hold.hpp"

#include <algorithm>

namespace berth {

double SpeedHold::next(double falling, double rising, double now_s) {
  const bool goes_on = now_s >= last_s_;
  last_s_ = now_s;
  if (rising <= scale_ || !goes_on) {
    waits_since_s_.reset();
    least_rising_ = 1;
  } else {
    if (!waits_since_s_) waits_since_s_ = now_s;
    least_rising_ = std::min(least_rising_, rising);
    if (now_s - *waits_since_s_ >= release_s_) {
      scale_ = least_rising_;
      waits_since_s_.reset();
      least_rising_ = 1;
    }
  }
  scale_ = std::min(scale_, falling);
  return scale_;
}

}  // namespace berth
