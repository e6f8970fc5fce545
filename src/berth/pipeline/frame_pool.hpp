#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "berth/pipeline/frame.hpp"

namespace berth {

/// Objects whose memory is used again once nobody holds them. May be taken from and given back by
/// any number of threads.
template <class T>
class Pool {
 public:
  /// One that nobody else holds, of any content. Who holds it longest gives it back, also after the
  /// pool is gone. Where there is none, `make` gives a new one.
  template <class Make>
  std::shared_ptr<T> take(Make make) {
    std::unique_ptr<T> one = free_->pop();
    if (!one) one = make();
    return {one.release(), [free = free_](T* used) { free->push(used); }};
  }
  std::shared_ptr<T> take() {
    return take([] { return std::make_unique<T>(); });
  }

 private:
  class Free {
   public:
    std::unique_ptr<T> pop() {
      const std::lock_guard lock(mutex_);
      if (objects_.empty()) return nullptr;
      std::unique_ptr<T> one = std::move(objects_.back());
      objects_.pop_back();
      return one;
    }
    void push(T* used) {
      const std::lock_guard lock(mutex_);
      objects_.emplace_back(used);
    }

   private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<T>> objects_;
  };

  std::shared_ptr<Free> free_ = std::make_shared<Free>();
};

using FramePool = Pool<Frame>;  ///< so that frames are not allocated anew

}  // namespace berth
