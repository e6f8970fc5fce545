// The page as it was built: all that the server ever serves.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace berth::app {

struct PageFile {
  std::string media_type;
  std::string bytes;
};

/// By the path of the request, such as "/" and "/page.js".
using PageFiles = std::map<std::string, PageFile, std::less<>>;

/// Reads the page from the first of these folders that has it. Throws std::runtime_error that says
/// how to build it where none has.
PageFiles read_page_files(const std::vector<std::filesystem::path>& folders);

/// Where the page of this program is: beside an installed one in share/berth/page, or in the folder
/// of its build.
std::vector<std::filesystem::path> program_page_folders();

}  // namespace berth::app
