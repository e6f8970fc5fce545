#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <stop_token>

namespace berth {

/// A fixed number of tasks at a time, in the order of their requests. Interleaving two tasks on one
/// core delays the shorter one without helping the longer.
class Turns {
 public:
  explicit Turns(int at_a_time) : at_a_time_(at_a_time) {}

  /// A place in the row, which its owner has to wait for.
  std::int64_t ask();
  /// Whether it came to that place's turn, which then has to be given back, before `stop`.
  bool wait(std::int64_t place, const std::stop_token& stop);
  void give_back();

 private:
  const int at_a_time_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::int64_t asked_ = 0;
  std::deque<std::int64_t> waiting_;
  int at_work_ = 0;
};

/// While it lives, its thread may make an image ready. All of a process share the processors but
/// one, which is left to requests.
class ImageTurn {
 public:
  /// Waits for it. So who has a turn may end a thread that waits for one.
  explicit ImageTurn(const std::stop_token& stop);
  ~ImageTurn();
  ImageTurn(const ImageTurn&) = delete;
  ImageTurn& operator=(const ImageTurn&) = delete;

  /// Not so where it was to stop before.
  bool has_come() const { return has_come_; }

 private:
  bool has_come_;
};

}  // namespace berth
