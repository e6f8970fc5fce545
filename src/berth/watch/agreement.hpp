#pragma once

#include <cstddef>
#include <vector>

namespace berth {

/// Two-valued state that changes once k of the last n verdicts say so. Verdicts of the old state
/// hold it in the same way: with k above n / 2 both cannot be had at once.
class Agreement {
 public:
  Agreement(int agreeing, int of) : agreeing_(agreeing), last_(static_cast<std::size_t>(of)) {}

  /// As if all verdicts so far had been this one.
  void begin(bool verdict) {
    last_.assign(last_.size(), verdict);
    true_ = verdict ? static_cast<int>(last_.size()) : 0;
    state_ = verdict;
  }
  /// Before n verdicts were given, the missing ones are false.
  void add(bool verdict) {
    true_ += static_cast<int>(verdict) - static_cast<int>(last_[next_]);
    last_[next_] = verdict;
    next_ = (next_ + 1) % last_.size();
    const int against = state_ ? static_cast<int>(last_.size()) - true_ : true_;
    if (against >= agreeing_) state_ = !state_;
  }
  bool state() const { return state_; }

 private:
  int agreeing_;
  std::vector<bool> last_;
  std::size_t next_ = 0;
  int true_ = 0;
  bool state_ = false;
};

}  // namespace berth
