#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

namespace berth_ros {

/// How long the questions since the last report took.
class QuestionTimes {
 public:
  struct Summary {
    std::int64_t count = 0;
    double median_us = 0;
    double p99_us = 0;
    double greatest_us = 0;
  };

  void add(double us) {
    const std::lock_guard lock(mutex_);
    // Of a node that nobody asks for reports.
    if (times_us_.size() == kMost) times_us_.clear();
    times_us_.push_back(us);
  }
  /// And begins anew.
  Summary take() {
    std::vector<double> times_us;
    {
      const std::lock_guard lock(mutex_);
      times_us.swap(times_us_);
    }
    if (times_us.empty()) return {};
    std::sort(times_us.begin(), times_us.end());
    const auto at = [&](double share) {
      return times_us[static_cast<std::size_t>(share * static_cast<double>(times_us.size() - 1))];
    };
    return {static_cast<std::int64_t>(times_us.size()), at(0.5), at(0.99), times_us.back()};
  }

 private:
  static constexpr std::size_t kMost = 10000;
  std::mutex mutex_;
  std::vector<double> times_us_;
};

}  // namespace berth_ros
