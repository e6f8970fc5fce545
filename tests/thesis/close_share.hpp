#pragma once

#include "thesis/link_distance.hpp"

namespace berth::testing {

/// Links that have a true distance, and those of them that a method finds close to it.
struct CloseShare {
  int links = 0;
  int close = 0;

  /// The thesis's "close" is 5 mm.
  void add(const LinkDistances& truth, const LinkDistances& found) {
    for (std::size_t i = 0; i < truth.links.size(); ++i) {
      if (truth.links[i].status != LinkStatus::ok) continue;
      ++links;
      close += found.links[i].distance_m <= truth.links[i].distance_m + 0.005f;
    }
  }
};

}  // namespace berth::testing
