#include "lab/filter/expected_ranges.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace berth::lab {

ExpectedRanges read_expected_ranges(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
  std::string line;
  std::getline(stream, line);
  ExpectedRanges ranges;
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    int frame = 0;
    std::string link;
    ExpectedRange range;
    fields >> frame >> link >> range.min_m >> range.max_m;
    range.is_checked = line.find("[checked") != std::string::npos;
    ranges[{frame, link}] = range;
  }
  return ranges;
}

}  // namespace berth::lab
