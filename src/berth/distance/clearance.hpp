#pragma once

#include <limits>
#include <memory>

#include "berth/distance/robot_patches.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth {

/// The arguments of find_clearance().
struct ClearanceRequest {
  /// Nothing may be nearer to the link than this.
  double needed_m = 0;
  /// Whether unknown space counts, or only what is occupied.
  bool unknown = true;
  /// It is given up before this number of pieces of link and space is taken apart, if it has
  /// not been by itself.
  int most_steps = std::numeric_limits<int>::max();
};

/// Whether a link has room.
struct Clearance {
  /// Nothing is nearer than what was needed, certified.
  bool is_clear = false;
  /// The length of a pair that is nearer; infinite where none was found. Where it is not clear
  /// either, the search was given up.
  float nearest_m = std::numeric_limits<float>::infinity();
  /// What it took, in the same pieces, rounded up.
  int steps = 0;
};

/// The memory of find_clearance(); one for each thread.
class ClearanceWorkspace {
 public:
  ClearanceWorkspace();
  ~ClearanceWorkspace();
  ClearanceWorkspace(const ClearanceWorkspace&) = delete;
  ClearanceWorkspace& operator=(const ClearanceWorkspace&) = delete;

 private:
  friend Clearance find_clearance(const LinkPatches&, const Pose&, const UnknownSpace&,
                                  const ClearanceRequest&, ClearanceWorkspace&);
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether everything is as far away from a link at X_BL as it needs. It ends with the first pair
/// that is nearer, or once there can be none: both come long before the distance itself is known.
/// A search that takes too long is given up, and then it is not clear. A link without triangles is
/// always clear. Allocates nothing once the workspace has grown.
Clearance find_clearance(const LinkPatches& link, const Pose& X_BL, const UnknownSpace& space,
                         const ClearanceRequest& request, ClearanceWorkspace& workspace);

}  // namespace berth
