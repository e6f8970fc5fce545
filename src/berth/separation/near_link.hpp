// Inside separation/ only: how near something may be to one link, by what is known and the policies
// for what is not.
#pragma once

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/separation/settings.hpp"
#include "berth/types/separation.hpp"

namespace berth {

/// Z_d of one camera for an obstacle at a depth of depth_m near the link: what the self filter
/// takes away beside the robot (tolerance or padding, whichever is more) and the noise of a
/// reading.
double camera_uncertainty_m(const CameraSettings& settings, LinkId link, double depth_m);

struct NearLink {
  double distance_m = 0;
  SeparationReason reason = SeparationReason::stale;
};

/// `range_m`: how far distances are looked for.
NearLink near_link(const SeparationSettings& settings, const LinkResult& link, double range_m);

/// `near` with one more thing that may be there, at distance_m.
NearLink with_unknown(const NearLink& near, UnknownPolicy policy, double distance_m,
                      SeparationReason reason);

}  // namespace berth
