#pragma once

#include <mutex>
#include <optional>
#include <vector>

#include "berth/pipeline/result.hpp"

namespace berth_ros {

/// How long the questions since the last report took.
class QuestionTimes {
 public:
  void add(double us) {
    const std::lock_guard lock(mutex_);
    // Of a node that nobody asks for reports.
    if (times_us_.size() == kMost) times_us_.clear();
    times_us_.push_back(us);
  }
  /// And begins anew. None where there was no question.
  std::optional<berth::RequestTiming> take() {
    std::vector<double> times_us;
    {
      const std::lock_guard lock(mutex_);
      times_us.swap(times_us_);
    }
    if (times_us.empty()) return std::nullopt;
    return berth::timing_of(std::move(times_us));
  }

 private:
  static constexpr std::size_t kMost = 10000;
  std::mutex mutex_;
  std::vector<double> times_us_;
};

}  // namespace berth_ros
