// Requests about one frame, none of which knows of the one before.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/query.hpp"

namespace berth::testing {

class FrameQuery {
 public:
  explicit FrameQuery(std::shared_ptr<const Robot> robot) : query_(std::move(robot)) {}

  const Result& ask(const Frame& frame, const RequestedJoints& joints = {},
                    std::optional<double> now_s = {}) {
    query_.forget();
    return query_.ask({.frames = frame, .joints = joints, .now_s = now_s});
  }

 private:
  Query query_;
};

inline std::vector<float> distances_of(const Result& result) {
  std::vector<float> distances;
  for (const LinkResult& link : result.links) distances.push_back(link.distance_m);
  return distances;
}

}  // namespace berth::testing
