#include "apps/view/page_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "berth/files/file_bytes.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

fs::path page_folder(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    if (fs::is_regular_file(folder / "index.html")) return folder;
    names.push_back(folder.string());
  }
  throw std::runtime_error(
      fmt::format("the page is not built: there is no index.html in {}; `make view` builds it, and "
                  "`cmake --install` takes it along then",
                  fmt::join(names, " and ")));
}

}  // namespace

PageFiles read_page_files(const std::vector<fs::path>& folders) {
  const fs::path folder = page_folder(folders);
  const auto file = [&](const char* name, const char* media_type) {
    return PageFile{media_type, read_file_bytes(folder / name)};
  };
  return {{"/", file("index.html", "text/html; charset=utf-8")},
          {"/page.js", file("page.js", "text/javascript; charset=utf-8")},
          {"/page.css", file("page.css", "text/css; charset=utf-8")}};
}

std::vector<fs::path> program_page_folders() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  return {folder.parent_path() / "share/berth/page", folder / "page"};
}

}  // namespace berth::app
