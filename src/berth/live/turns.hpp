#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace berth {

/// So many pieces of work at a time, in the order in which they were asked for. Where a processor
/// goes to and fro between two pieces, both are done when the longer one is.
class Turns {
 public:
  explicit Turns(std::int64_t at_a_time) : at_a_time_(at_a_time) {}

  /// A place in the row. Its owner has to wait for it and give it back.
  std::int64_t ask();
  void wait(std::int64_t place);
  void give_back();

 private:
  const std::int64_t at_a_time_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t asked_ = 0;
  std::int64_t given_back_ = 0;
};

/// While it lives, its thread may make an image ready. All of a process share the processors but
/// one, which is left to who asks.
class ImageTurn {
 public:
  ImageTurn();
  ~ImageTurn();
  ImageTurn(const ImageTurn&) = delete;
  ImageTurn& operator=(const ImageTurn&) = delete;

  /// Runs it, with the help of TBB's workers on those processors alone.
  void run(const std::function<void()>& work) const;
};

}  // namespace berth
