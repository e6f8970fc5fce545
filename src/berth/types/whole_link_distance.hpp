// The distance of a whole link to everything that several cameras left.
#pragma once

#include "berth/types/robot_image.hpp"
#include "berth/types/space_pair.hpp"

namespace berth {

/// The two answers for one link. `reading.distance_m` is never below `nearest.distance_m` where both
/// are known.
struct WholeLinkDistance {
  LinkId id = kNoLink;
  /// To what is seen or hidden.
  SpacePair nearest;
  /// To what is seen alone.
  SpacePair reading;
};

}  // namespace berth
