#pragma once

#include "thesis/image_request.hpp"
#include "thesis/lattice/link_lattice.hpp"
#include "thesis/lattice/link_pixels.hpp"
#include "thesis/link_distance.hpp"

namespace berth {

/// The memory of lattice(), made once and used for every request; one for each thread that asks.
/// It carries nothing from one answer to the next.
struct LatticeWorkspace {
  LinkPixels pixels;
  LinkLattice lattice;
};

/// The thesis's evaluator on the CPU (Hirt 2.2.4, 3.1.2), **approximate**. Some pixels of each link
/// (a lattice) are tried against some obstacle pixels. Around the closest one the lattice is made
/// finer, again and again, until the final radius: there all pixels of the link are tried against
/// all obstacle pixels of their region.
///
/// A distance is that of a real pair, so never below brute_force's. It can be too large, and a link
/// can be none_in_range although a pair is in range, since the lattices may pass over it. So
/// lower_bound_m is 0 for every visible link: nothing is certified. Otherwise as brute_force;
/// out.pairs counts the pairs computed. Allocates nothing once the workspace and `out` have grown
/// to the scene. Throws std::invalid_argument for bad settings.
void lattice(const ImageRequest& request, LatticeWorkspace& workspace, LinkDistances& out);

}  // namespace berth
