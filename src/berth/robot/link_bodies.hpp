// Inside robot/ only.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "berth/robot/urdf.hpp"

namespace berth {

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Fills the meshes of all links that are not in ignore_links with the shapes that RobotSettings
/// ask for. Left out, unless the settings name the link as environment or guarded, is what no body
/// is: a see-through visual shape that nothing avoids in collisions, such as a zone or a field of
/// view; and a link of a collision shape alone around one that is seen, a coarser shape of the same
/// body, beside which nothing near would be seen. Warns of these. Throws as Urdf does.
void load_bodies(const RobotSettings& settings, const Urdf& urdf, RobotModel& model);

}  // namespace berth
