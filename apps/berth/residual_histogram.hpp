#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "berth/types/image.hpp"

namespace berth::app {

/// How often reading - model has which value, of readings that are the robot's (within 10 cm).
class ResidualHistogram {
 public:
  static constexpr double kStep_m = 0.002;
  /// The outermost bins hold what lies beyond them, too.
  static constexpr int kBins = 61;

  void add(DepthView residual_m);
  std::int64_t count() const { return count_; }
  /// Of all readings added; 0 where there are none.
  double share(int bin) const;
  /// The middle of a bin.
  static double residual_m(int bin) { return (bin - kBins / 2) * kStep_m; }

 private:
  std::array<std::int64_t, kBins> bins_{};
  std::int64_t count_ = 0;
};

/// An inline SVG with both; classes before, after, axis and label are left to the page's style.
std::string histogram_svg(const ResidualHistogram& before, const ResidualHistogram& after);

}  // namespace berth::app
