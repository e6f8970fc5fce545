#include "apps/berth/speed_changes.hpp"

#include <fmt/format.h>

#include "berth/results/result_text.hpp"

namespace berth::app {

void SpeedChanges::take(double time_s, const Result& result) {
  if (!result.separation) return;
  if (result.separation->state == before_) return;
  before_ = result.separation->state;
  fmt::print("{:9.3f} s  {}\n", time_s, separation_text(result));
  std::fflush(stdout);
}

}  // namespace berth::app
