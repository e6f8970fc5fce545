// Inside robot/ only.
#pragma once

#include <filesystem>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// What an SRDF's `disable_collisions` name. Throws std::runtime_error that names file, line and
/// what was expected.
std::vector<AllowedContact> read_disabled_collisions(const std::filesystem::path& srdf);

}  // namespace berth
