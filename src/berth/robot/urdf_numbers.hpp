// Inside robot/ only.
#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>

namespace berth {

/// Refuses a coordinate, length or angle of a link or joint that is no number: urdfdom tells
/// neither the line nor what was expected. `text` is the file that `robot` was read from. Throws
/// std::runtime_error with file, line, element, value and what was expected.
void require_urdf_numbers(const std::filesystem::path& path, const std::string& text,
                          const pugi::xml_node& robot);

}  // namespace berth
