#include "berth/pipeline/frame_pool.hpp"

namespace berth {

std::shared_ptr<Frame> FramePool::take() {
  std::unique_ptr<Frame> frame;
  {
    const std::lock_guard lock(free_->mutex);
    if (!free_->frames.empty()) {
      frame = std::move(free_->frames.back());
      free_->frames.pop_back();
    }
  }
  if (!frame) frame = std::make_unique<Frame>();
  return {frame.release(), [free = free_](Frame* used) {
            const std::lock_guard lock(free->mutex);
            free->frames.emplace_back(used);
          }};
}

}  // namespace berth
