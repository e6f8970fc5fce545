#include "lab/bench/peer.hpp"

namespace berth::lab {

std::vector<std::unique_ptr<Peer>> make_peers() {
  std::vector<std::unique_ptr<Peer>> peers;
  peers.push_back(make_berth_exact());
  for (auto& variant : make_berth_variants()) peers.push_back(std::move(variant));
  peers.push_back(make_nanoflann());
  peers.push_back(make_embree());
  peers.push_back(make_fcl_octomap(0.02));
  peers.push_back(make_fcl_octomap(0.01));
  return peers;
}

}  // namespace berth::lab
