#include "berth/live/turns.hpp"

#include <tbb/info.h>

#include <algorithm>

namespace berth {
namespace {

Turns& image_turns() {
  static Turns turns(std::max(1, tbb::info::default_concurrency() - 1));
  return turns;
}

}  // namespace

std::int64_t Turns::ask() {
  const std::lock_guard lock(mutex_);
  return asked_++;
}

void Turns::wait(std::int64_t place) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return place < given_back_ + at_a_time_; });
}

void Turns::give_back() {
  {
    const std::lock_guard lock(mutex_);
    ++given_back_;
  }
  changed_.notify_all();
}

ImageTurn::ImageTurn() { image_turns().wait(image_turns().ask()); }
ImageTurn::~ImageTurn() { image_turns().give_back(); }

}  // namespace berth
