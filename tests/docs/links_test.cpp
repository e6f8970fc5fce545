// Every relative link of the documents leads to a file, and to a heading where it names one.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<fs::path> documents() {
  const fs::path root = BERTH_SOURCE;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(root)) files.push_back(entry.path());
  for (const char* folder : {"docs", "lab", "data", "examples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      files.push_back(entry.path());
    }
  }
  std::erase_if(files, [](const fs::path& file) { return file.extension() != ".md"; });
  return files;
}

/// The name that a page on the flying pixels gives a heading: small letters, digits, - and _, - for
/// a blank.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const unsigned char c : heading) {
    if (c == ' ') anchor += '-';
    if (std::isalnum(c) || c == '-' || c == '_' || c > 127) anchor += char(std::tolower(c));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& file) {
  std::set<std::string> anchors;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t text = line.find_first_not_of('#');
    if (text == 0 || text == std::string::npos || line[text] != ' ') continue;
    anchors.insert(anchor_of(line.substr(text + 1)));
  }
  return anchors;
}

void expect_target(const fs::path& file, const std::string& link) {
  const std::size_t hash = link.find('#');
  const std::string path = link.substr(0, hash);
  const fs::path target = path.empty() ? file : file.parent_path() / path;
  ASSERT_TRUE(fs::exists(target)) << file << " links to " << link << ", which there is not";
  if (hash == std::string::npos || target.extension() != ".md") return;
  EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1)))
      << file << " links to " << link << ": no such heading";
}

TEST(Links, LeadSomewhere) {
  const std::regex link(R"(\]\(([^()\s]+)\))");
  int count = 0;
  for (const fs::path& file : documents()) {
    const std::string text = text_of(file);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.find("://") != std::string::npos) continue;
      ++count;
      expect_target(file, target);
    }
  }
  EXPECT_GT(count, 20);
}

}  // namespace
