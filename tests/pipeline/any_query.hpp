// Requests about one frame by any method, so that one test holds for all.
#pragma once

#include <memory>
#include <optional>

#include "berth/image_distance/image_query.hpp"
#include "berth/pipeline/query.hpp"

namespace berth::testing {

class AnyQuery {
 public:
  /// A method on the processor.
  AnyQuery(std::shared_ptr<const Robot> robot, Method method) {
    if (compares_images(method)) {
      images_.emplace(std::move(robot), method);
    } else {
      whole_.emplace(std::move(robot));
    }
  }

  const Result& ask(const Frame& frame, const RequestedJoints& joints = {},
                    std::optional<double> now_s = {}) {
    if (images_) return images_->ask(frame, joints, now_s);
    // Nothing of the request before, as with images: the same request has the same result.
    whole_->forget();
    return whole_->ask({.frames = frame, .joints = joints, .now_s = now_s});
  }

 private:
  std::optional<Query> whole_;
  std::optional<ImageQuery> images_;
};

inline std::vector<float> distances_of(const Result& result) {
  std::vector<float> distances;
  for (const LinkResult& link : result.links) distances.push_back(link.distance_m);
  return distances;
}

}  // namespace berth::testing
