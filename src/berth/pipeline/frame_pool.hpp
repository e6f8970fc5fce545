#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "berth/pipeline/frame.hpp"

namespace berth {

/// Frames whose memory is used again once nobody holds them. May be taken from and given back by
/// any number of threads.
class FramePool {
 public:
  /// One that nobody else holds, of any content. Who holds it longest gives it back, also after the
  /// pool is gone.
  std::shared_ptr<Frame> take();

 private:
  struct Free {
    std::mutex mutex;
    std::vector<std::unique_ptr<Frame>> frames;
  };

  std::shared_ptr<Free> free_ = std::make_shared<Free>();
};

}  // namespace berth
