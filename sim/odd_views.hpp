// What random scenes hardly ever draw.
#pragma once

#include <string>
#include <vector>

#include "sim/drawn_views.hpp"

namespace berth::sim {

struct NamedViews {
  std::string name;
  DrawnViews drawn;
};

/// Small images of one robot with: odd image sizes, a camera in the middle of the robot, one that
/// looks away, two identical cameras, a plate right before each camera, no robot in view, an
/// obstacle that goes through a link, cameras that see the tip of the robot alone, no reading at
/// all, a single reading, and floor and wall alone.
std::vector<NamedViews> odd_views(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                                  std::uint32_t seed);

}  // namespace berth::sim
