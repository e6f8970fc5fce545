#include "berth/robot/urdf_numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "berth/files/number.hpp"
#include "berth/files/xml.hpp"

namespace berth {
namespace {

struct Numbers {
  std::string_view element;
  const char* attribute;
  int count;
};

constexpr std::array kNumbers{Numbers{"origin", "xyz", 3},       Numbers{"origin", "rpy", 3},
                              Numbers{"axis", "xyz", 3},         Numbers{"box", "size", 3},
                              Numbers{"mesh", "scale", 3},       Numbers{"sphere", "radius", 1},
                              Numbers{"cylinder", "radius", 1},  Numbers{"cylinder", "length", 1},
                              Numbers{"limit", "lower", 1},      Numbers{"limit", "upper", 1},
                              Numbers{"mimic", "multiplier", 1}, Numbers{"mimic", "offset", 1}};

bool holds(const char* value, int count) {
  std::istringstream words(value);
  int found = 0;
  for (std::string word; words >> word; ++found) {
    if (!parse_finite(word)) return false;
  }
  return found == count;
}

/// In the link or joint `part` and what is in it.
void require_numbers_in(const std::filesystem::path& path, const std::string& text,
                        const pugi::xml_node& part, const pugi::xml_node& node) {
  for (const Numbers& numbers : kNumbers) {
    const pugi::xml_attribute value = node.attribute(numbers.attribute);
    if (numbers.element != node.name() || !value || holds(value.value(), numbers.count)) continue;
    throw std::runtime_error(
        fmt::format("{}:{}: {} \"{}\": <{}> has {}=\"{}\"; expected {} finite number{}",
                    path.string(), line_of(text, node.offset_debug()), part.name(),
                    part.attribute("name").value(), node.name(), numbers.attribute, value.value(),
                    numbers.count, numbers.count == 1 ? "" : "s"));
  }
  for (const pugi::xml_node& child : node.children()) require_numbers_in(path, text, part, child);
}

}  // namespace

void require_urdf_numbers(const std::filesystem::path& path, const std::string& text,
                          const pugi::xml_node& robot) {
  for (const pugi::xml_node& part : robot.children()) {
    const std::string_view kind = part.name();
    if (kind == "link" || kind == "joint") require_numbers_in(path, text, part, part);
  }
}

}  // namespace berth
