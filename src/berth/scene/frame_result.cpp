#include "berth/scene/frame_result.hpp"

#include <algorithm>
#include <cmath>

namespace berth {

AnswerTiming timing_of(std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  // The least time that this share of them did not exceed.
  const auto percentile = [&](double share) {
    return times_us[static_cast<std::size_t>(
                        std::ceil(share * static_cast<double>(times_us.size()))) -
                    1];
  };
  return {static_cast<int>(times_us.size()), times_us.front(), percentile(0.5), percentile(0.99),
          times_us.back()};
}

}  // namespace berth
