#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

#include "berth/live/live_camera.hpp"

namespace berth_ros {

/// How many images a second a camera sends, and how many arrive, by the stamps of those that do:
/// most gaps between stamps are one period, and one that is longer holds images that were lost.
class ImageRate {
 public:
  void add(double stamp_s) {
    const double gap_s = stamp_s - newest_s_;
    if (count_ > 0 && !(gap_s > 0 && gap_s < kPause_s)) count_ = 0;
    if (count_ > 0) gaps_s_[(count_ - 1) % gaps_s_.size()] = gap_s;
    newest_s_ = stamp_s;
    ++count_;
  }
  /// Whether it has seen enough to tell.
  bool is_known() const { return count_ > gaps_s_.size(); }
  double sent_hz() const { return 1 / period_s(); }
  double arrived_hz() const { return static_cast<double>(gaps_s_.size()) / sum_s(); }
  /// Empty unless a tenth of them is lost, in several places: one long gap is a clock that jumped,
  /// or a camera that paused.
  std::string trouble() const {
    if (!is_known() || arrived_hz() > 0.9 * sent_hz() || long_gaps() < kLeastLongGaps) return "";
    char text[256];
    std::snprintf(text, sizeof text,
                  "%.0f of %.0f images a second arrive: the DDS receive buffer may be too small "
                  "(berth's ROS page, \"Images that get lost\")",
                  arrived_hz(), sent_hz());
    return text;
  }

 private:
  /// A camera that stops, or a bag that begins again, loses no image: it is counted anew.
  static constexpr double kPause_s = 0.5;
  static constexpr int kLeastLongGaps = 3;

  double sum_s() const {
    double sum_s = 0;
    for (const double gap_s : gaps_s_) sum_s += gap_s;
    return sum_s;
  }
  std::ptrdiff_t long_gaps() const {
    const double long_s = 1.5 * period_s();
    return std::count_if(gaps_s_.begin(), gaps_s_.end(),
                         [long_s](double gap_s) { return gap_s > long_s; });
  }
  /// A fifth of the gaps is shorter: where four of five images are lost, one in five still follows
  /// the one before.
  double period_s() const {
    std::array<double, 64> sorted_s = gaps_s_;
    std::sort(sorted_s.begin(), sorted_s.end());
    return sorted_s[sorted_s.size() / 5];
  }

  std::array<double, 64> gaps_s_ = {};
  double newest_s_ = 0;
  std::size_t count_ = 0;
};

/// Empty unless a tenth of a camera's images between two reports, and more than a hiccup, was
/// dropped for newer ones.
inline std::string overload_trouble(const berth::LiveCameraCounts& before,
                                    const berth::LiveCameraCounts& now) {
  constexpr std::int64_t kHiccup = 2;
  const std::int64_t dropped = now.dropped - before.dropped;
  const std::int64_t all = now.images - before.images + dropped;
  if (dropped <= kHiccup || 10 * dropped < all) return "";
  return std::to_string(dropped) + " of " + std::to_string(all) +
         " images were dropped for newer ones: too much work for this computer, or joint states "
         "come late (berth's ROS page, \"How fast\")";
}

}  // namespace berth_ros
