#include "berth/live/turns.hpp"

#include <tbb/info.h>

#include <algorithm>

namespace berth {
namespace {

/// Never destroyed: a camera that is static may end after all that is not.
Turns& image_turns() {
  static Turns* const turns = new Turns(std::max(1, tbb::info::default_concurrency() - 1));
  return *turns;
}

}  // namespace

std::int64_t Turns::ask() {
  const std::lock_guard lock(mutex_);
  waiting_.push_back(asked_);
  return asked_++;
}

bool Turns::wait(std::int64_t place, const std::stop_token& stop) {
  bool has_come = false;
  {
    std::unique_lock lock(mutex_);
    has_come = changed_.wait(lock, stop,
                             [&] { return waiting_.front() == place && at_work_ < at_a_time_; });
    std::erase(waiting_, place);
    at_work_ += has_come;
  }
  // The next one may be first now.
  changed_.notify_all();
  return has_come;
}

void Turns::give_back() {
  {
    const std::lock_guard lock(mutex_);
    --at_work_;
  }
  changed_.notify_all();
}

ImageTurn::ImageTurn(const std::stop_token& stop)
    : has_come_(image_turns().wait(image_turns().ask(), stop)) {}

ImageTurn::~ImageTurn() {
  if (has_come_) image_turns().give_back();
}

}  // namespace berth
