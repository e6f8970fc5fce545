#pragma once

#include <string>
#include <vector>

namespace berth_ros {

/// The links that an SRDF takes out of all collisions: those of disable_default_collisions that no
/// enable_collisions names. Pairs of links (disable_collisions) say nothing of what is around the
/// robot. Throws std::runtime_error with the file's name for one that is missing or no SRDF.
std::vector<std::string> links_without_collisions(const std::string& srdf_file);

}  // namespace berth_ros
