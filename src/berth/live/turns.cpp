#include "berth/live/turns.hpp"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace berth {
namespace {

struct ImageCores {
  int count = std::max(1, tbb::info::default_concurrency() - 1);
  Turns turns{count};
  tbb::task_arena arena{count};
};

ImageCores& image_cores() {
  static ImageCores cores;
  return cores;
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

ImageTurn::ImageTurn() { image_cores().turns.wait(image_cores().turns.ask()); }
ImageTurn::~ImageTurn() { image_cores().turns.give_back(); }
void ImageTurn::run(const std::function<void()>& work) const { image_cores().arena.execute(work); }

}  // namespace berth
