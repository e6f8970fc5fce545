// What a MeshTree is, for those who ask FCL themselves. FCL's headers take seconds to compile.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

namespace berth::sim {

struct FclMesh : fcl::BVHModel<fcl::OBBRSSd> {};

}  // namespace berth::sim
