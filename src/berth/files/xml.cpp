#include "berth/files/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

constexpr int kDeepestNesting = 200;

struct FindTooDeep : pugi::xml_tree_walker {
  bool for_each(pugi::xml_node& node) override {
    if (depth() < kDeepestNesting) return true;
    found = node;
    return false;
  }
  pugi::xml_node found;
};

}  // namespace

std::ptrdiff_t line_of(const std::string& text, std::ptrdiff_t offset) {
  const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, text.size());
  return 1 + std::count(text.begin(), end, '\n');
}

void parse_xml(const std::filesystem::path& path, const std::string& text, const char* refusal,
               pugi::xml_document& document) {
  const auto fail = [&](std::ptrdiff_t offset, const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}: {}", path.string(), line_of(text, offset), refusal, what));
  };
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) fail(result.offset, fmt::format("{}; expected complete XML", result.description()));
  FindTooDeep walker;
  document.traverse(walker);
  if (walker.found) {
    fail(walker.found.offset_debug(), fmt::format("<{}> is nested {} deep; expected less than that",
                                                  walker.found.name(), kDeepestNesting + 1));
  }
}

}  // namespace berth
