#include "berth/record/first_difference.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace berth {
namespace {

using Json = nlohmann::ordered_json;

/// Such as "[arm_link_3]" for a link's part in a list, else "[2]".
std::string place_text(const Json& element, std::size_t i) {
  for (const char* name : {"link", "camera"}) {
    if (element.is_object() && element.contains(name) && element[name].is_string()) {
      return fmt::format("[{}]", element[name].get<std::string>());
    }
  }
  return fmt::format("[{}]", i);
}

std::optional<ReplayDifference> compare(const std::string& field, const Json& a, const Json& b) {
  if (a == b && a.dump() == b.dump()) return std::nullopt;
  if (a.is_object() && b.is_object()) {
    const std::string before = field.empty() ? "" : field + ".";
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) return ReplayDifference{before + key, value.dump(), "nothing"};
      if (const auto found = compare(before + key, value, b[key])) return found;
    }
    for (const auto& [key, value] : b.items()) {
      if (!a.contains(key)) return ReplayDifference{before + key, "nothing", value.dump()};
    }
  }
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (const auto found = compare(field + place_text(a[i], i), a[i], b[i])) return found;
    }
  }
  return ReplayDifference{field, a.dump(), b.dump()};
}

}  // namespace

std::optional<ReplayDifference> first_difference(const std::string& recorded,
                                                 const std::string& replayed) {
  if (recorded == replayed) return std::nullopt;
  return compare("", Json::parse(recorded), Json::parse(replayed));
}

}  // namespace berth
