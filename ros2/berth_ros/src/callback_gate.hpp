// How callbacks use what a node's configuration made, while it may be ended, and what they throw.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>

namespace berth_ros {

/// Callbacks pass it to what one configuration of a node made. Cleanup runs in a callback itself:
/// other threads of the executor may be within others, or have already taken up one that is about
/// to begin, also of a subscription that is gone. Each callback therefore keeps the gate of its
/// configuration, and looks at it before anything else.
///
/// It is not for the threads of images and cameras, which cleanup waits for: they never pass it,
/// and nobody holds it while they end.
class CallbackGate {
 public:
  /// Gets what a callback threw, in its thread.
  using OnError = std::function<void(const std::string&)>;
  explicit CallbackGate(OnError on_error) : on_error_(std::move(on_error)) {}

  /// Held by who makes a configuration: callbacks wait until all is made. To be let go before
  /// close().
  std::unique_lock<std::shared_mutex> hold() { return std::unique_lock(mutex_); }

  /// Held by a callback while it runs, beside any number of others. Holds nothing where the gate is
  /// closed: then the callback does nothing.
  std::shared_lock<std::shared_mutex> enter() {
    std::shared_lock lock(mutex_);
    if (!is_open_) lock.unlock();
    return lock;
  }

  /// Calls it within, unless the gate is closed. No exception gets out.
  template <class Call>
  void run(const Call& call) {
    const auto pass = enter();
    if (!pass) return;
    try {
      call();
    } catch (const std::exception& error) {
      on_error_(error.what());
    }
  }

  /// Waits until no callback is within; from then on none comes in. Not to be called in a callback
  /// that has passed it.
  void close() {
    const std::lock_guard lock(mutex_);
    is_open_ = false;
  }

 private:
  OnError on_error_;
  std::shared_mutex mutex_;
  bool is_open_ = true;
};

}  // namespace berth_ros
