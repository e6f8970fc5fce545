// Searches for the closest points of two links: LinkSearch::link in the frame of another one.
#pragma once

#include "berth/distance/link_search.hpp"

namespace berth::mesh {

/// Starts with both whole links, and an empty front. X_BL of the search is the pose of its link in
/// the frame of the other one.
void start_link_pair(const LinkPatches& other, LinkSearch& search);

/// Goes on with the front of the request before: what may be near enough by now is searched for. Of
/// two leaves it is seen first whether the plane that was found between them still is.
void take_link_pair_below(const LinkPatches& other, LinkSearch& search);

/// Searches on among the triangles of `other`. Ends when the search is done, or after about `steps`
/// patches. `best_pixel` is the place of the other link's triangle.
void search_link_pair(const LinkPatches& other, int steps, LinkSearch& search);

/// By how much a plane keeps all of two links apart, with the link at X_FL in the frame of `other`:
/// across the way from the best pair's point of the other one to that of the link. Below 0 where it
/// does not.
float apart_at_pair_m(const LinkPatches& other, const Pose& X_FL, const LinkSearch& search);

/// The closest points of the best pair's triangles. There is one.
ConvexPair best_pair_of(const LinkPatches& other, const LinkSearch& search);

}  // namespace berth::mesh
