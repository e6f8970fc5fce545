// What the search for one link reports in the end.
#pragma once

#include "berth/distance/link_search.hpp"
#include "berth/types/closest_pair.hpp"

namespace berth::mesh {

/// The best pair and how far it is certified; `is_shadow` where all behind a reading is hidden. The
/// search keeps the pair's points for the next request.
SpacePair pair_of(const UnknownSpace& space, bool is_shadow, LinkSearch& search);

/// Makes a link's two answers such that they do not contradict each other.
void reconcile(WholeLinkDistance& link);

}  // namespace berth::mesh
