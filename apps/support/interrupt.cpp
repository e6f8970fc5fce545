#include "apps/support/interrupt.hpp"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

namespace berth::app {
namespace {

// A signal handler can reach nothing but a global.
volatile std::sig_atomic_t interrupted = 0;

void note(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

/// A signal handler may not call std::stop_source.
class InterruptWatch {
 public:
  InterruptWatch()
      : thread_([this](const std::stop_token& end) {
          std::unique_lock lock(mutex_);
          while (interrupted == 0 && !end.stop_requested()) {
            changed_.wait_for(lock, end, std::chrono::milliseconds(20), [] { return false; });
          }
          if (interrupted != 0) source_.request_stop();
        }) {}

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::jthread thread_;
};

}  // namespace

void note_interrupts() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

void stop_if_interrupted() {
  if (interrupted != 0) throw Interrupted{};
}

std::stop_token interruption() {
  static const InterruptWatch watch;
  return watch.token();
}

}  // namespace berth::app
