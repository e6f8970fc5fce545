// Requests by any method on the processor, for what is measured with each of them.
#pragma once

#include <memory>
#include <optional>

#include "berth/image_distance/image_query.hpp"
#include "berth/pipeline/query.hpp"

namespace berth::lab {

/// What an observer's frames are for, where MethodQuery is asked about them.
inline FrameUse frame_use(Method method) {
  return compares_images(method) ? FrameUse::image_query : FrameUse::any_query;
}

class MethodQuery {
 public:
  /// Throws std::invalid_argument for a method that runs on OpenGL.
  MethodQuery(const std::shared_ptr<const Robot>& robot, Method method,
              const ImageSettings& images = {}) {
    if (compares_images(method)) {
      images_.emplace(robot, method, images);
    } else {
      whole_.emplace(robot);
    }
  }

  /// A method that compares images looks at the first frame alone. Valid until the next request.
  const Result& ask(const Request& request) {
    if (whole_) return whole_->ask(request);
    const Frame* first = request.frames.get().front();
    return images_->ask(first ? *first : none_, request.joints, request.now_s);
  }
  /// Those of the last request; null with a method that compares images.
  const FrameSet* frames() const { return whole_ ? &whole_->frames() : nullptr; }

 private:
  std::optional<Query> whole_;
  std::optional<ImageQuery> images_;
  const Frame none_ = {};
};

}  // namespace berth::lab
