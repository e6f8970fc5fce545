#pragma once

#include <memory>

#include "berth/distance/robot_patches.hpp"

namespace berth {

/// Each moved link's surface cut in eight, by the middle planes of the box around it: what is
/// nearest to each of them lies on several sides of the link. LinkPatches::link is the link that an
/// eighth is of, in the frame of which it lies. Eighths without a surface are left out.
std::shared_ptr<const RobotPatches> build_link_eighths(const RobotModel& model);

}  // namespace berth
