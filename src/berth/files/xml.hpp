// XML looked at before a library with less patience gets it.
#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>

namespace berth {

/// Parses the text without recursion. Throws std::runtime_error with file, line, `refusal` (such as
/// "not a valid URDF"), what is wrong and what was expected: not well-formed, or elements nested
/// deeper than 200, at which others' recursion may end the process.
void parse_xml(const std::filesystem::path& path, const std::string& text, const char* refusal,
               pugi::xml_document& document);

/// The line of a place in the text, from 1.
std::ptrdiff_t line_of(const std::string& text, std::ptrdiff_t offset);

}  // namespace berth
