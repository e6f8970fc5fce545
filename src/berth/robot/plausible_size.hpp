// Inside robot/, and for who reads a robot from elsewhere.
#pragma once

#include <filesystem>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// How far a mesh reaches from its origin, in m; infinite or NaN where any vertex is.
double reach_m(const TriangleMesh& mesh);

/// Refuses what is no robot's size: a link to evaluate that reaches farther than 100 m from its
/// origin, as one in millimetres does; environment or a joint farther than 100 km from its parent,
/// and what is not finite. A link of points alone, which no camera sees. Throws std::runtime_error
/// that names the file, the link, the value and what was expected.
void require_plausible_size(const std::filesystem::path& file, const RobotModel& model);

}  // namespace berth
