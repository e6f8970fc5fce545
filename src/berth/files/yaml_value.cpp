#include "berth/files/yaml_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <sstream>

#include "berth/files/edit_distance.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/files/number.hpp"

namespace berth {
namespace {

/// More of a text would hide what was expected: of a URDF that is given as a scene, say.
constexpr std::size_t kMostToldBytes = 60;

std::string describe_text(const std::string& text) {
  if (text.empty()) return "an empty text";
  if (text.size() <= kMostToldBytes) return text;
  return fmt::format("a text of {} bytes that begins with {}", text.size(),
                     text.substr(0, text.find_last_of(' ', kMostToldBytes)));
}

std::string describe(const YAML::Node& node) {
  if (node.IsScalar()) return describe_text(node.Scalar());
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  return node.IsMap() ? "a map" : "nothing";
}

int line_of(const YAML::Node& node) { return node.Mark().line + 1; }

std::string join_keys(const std::string& outer, const std::string& key) {
  return outer.empty() ? key : outer + "." + key;
}

struct IgnoreEvents : YAML::EventHandler {
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Style = YAML::EmitterStyle::value;
  using Tag = const std::string&;
  void OnDocumentStart(const Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, Anchor) override {}
  void OnAlias(const Mark&, Anchor) override {}
  void OnScalar(const Mark&, Tag, Anchor, Tag) override {}
  void OnSequenceStart(const Mark&, Tag, Anchor, Style) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark&, Tag, Anchor, Style) override {}
  void OnMapEnd() override {}
};

/// 0, 1, or 2 for more: YAML::LoadAll() finds documents without end behind some wrong commas.
int count_documents(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  IgnoreEvents ignore;
  int count = 0;
  while (count < 2 && parser.HandleNextDocument(ignore)) ++count;
  return count;
}

/// The first line with a tab in its indentation, from 1; 0 where there is none. YAML forbids them
/// there, and yaml-cpp calls that an illegal value.
int indented_by_tab(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t end = line.find_first_not_of(" \t");
    if (end != std::string::npos && line.find('\t') < end) return number;
  }
  return 0;
}

}  // namespace

void YamlValue::fail(std::string_view found, std::string_view expected) const {
  throw_bad_file(place_, found, expected);
}

void YamlValue::fail(std::string_view expected) const { fail(describe(node_), expected); }

std::string YamlValue::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("a text");
  return node_.Scalar();
}

std::string YamlValue::raw_text() const { return node_.IsScalar() ? node_.Scalar() : text(); }

std::string YamlValue::one_of(const std::vector<std::string_view>& choices) const {
  if (node_.IsScalar() &&
      std::find(choices.begin(), choices.end(), node_.Scalar()) != choices.end()) {
    return node_.Scalar();
  }
  fail(fmt::format("one of {}", fmt::join(choices, ", ")));
}

std::filesystem::path YamlValue::path() const {
  return (place_.file.parent_path() / text()).lexically_normal();
}

bool YamlValue::boolean() const {
  bool value = false;
  if (!YAML::convert<bool>::decode(node_, value)) fail("true or false");
  return value;
}

int YamlValue::count() const {
  const std::optional<int> value = node_.IsScalar() ? parse_integer(node_.Scalar()) : std::nullopt;
  if (!value || *value < 0) fail("a whole number, 0 or more");
  return *value;
}

double YamlValue::number() const {
  const std::optional<double> value =
      node_.IsScalar() ? parse_finite(node_.Scalar()) : std::nullopt;
  if (!value && node_.IsScalar() && node_.Scalar().find(',') != std::string::npos) {
    fail("a finite number, with a point in place of the comma");
  }
  if (!value) fail("a finite number");
  return *value;
}

double YamlValue::positive() const {
  const double value = number();
  if (value <= 0) fail("a number above 0");
  return value;
}

double YamlValue::non_negative() const {
  const double value = number();
  if (value < 0) fail("a number, 0 or more");
  return value;
}

std::vector<double> YamlValue::numbers() const {
  std::vector<double> values;
  for (const YamlValue& item : list()) values.push_back(item.number());
  return values;
}

std::vector<double> YamlValue::numbers(std::size_t how_many) const {
  if (!is_list() || node_.size() != how_many) fail(fmt::format("a list of {} numbers", how_many));
  return numbers();
}

std::vector<std::string> YamlValue::texts() const {
  std::vector<std::string> values;
  for (const YamlValue& item : list()) values.push_back(item.text());
  return values;
}

std::vector<YamlValue> YamlValue::list() const {
  if (!is_list()) fail("a list");
  std::vector<YamlValue> items;
  for (const YAML::Node& item : node_) {
    const std::string where = fmt::format("{}[{}]", place_.where, items.size());
    items.push_back({item, {place_.file, line_of(item), where}});
  }
  return items;
}

std::vector<std::pair<std::string, YamlValue>> YamlValue::entries() const {
  if (!node_.IsMap()) fail("a map of keys and values");
  std::vector<std::pair<std::string, YamlValue>> entries;
  for (const auto& entry : node_) {
    const YamlValue key(entry.first, {place_.file, line_of(entry.first), place_.where});
    const std::string name = key.text();
    const FilePlace place = {place_.file, key.place().line, join_keys(place_.where, name)};
    const auto same = [&](const auto& earlier) { return earlier.first == name; };
    if (std::any_of(entries.begin(), entries.end(), same)) {
      throw_bad_file(place, "the key stands here a second time", "each key once");
    }
    entries.emplace_back(name, YamlValue(entry.second, place));
  }
  return entries;
}

YamlMap::YamlMap(const YamlValue& value, const std::vector<std::string_view>& known,
                 const std::vector<std::string_view>& unspoken)
    : YamlMap(value) {
  for (const auto& [key, entry] : entries_) {
    if (std::ranges::find(known, key) != known.end()) continue;
    if (std::ranges::find(unspoken, key) != unspoken.end()) continue;
    require_no_comma(key);
    entry.fail("unknown key", fmt::format("{} (the nearest), or another of {}", nearest(key, known),
                                          fmt::join(known, ", ")));
  }
}

void YamlMap::require_no_comma(std::string_view key) const {
  const auto at = std::ranges::find(entries_, key, &std::pair<std::string, YamlValue>::first);
  if (at == entries_.begin() || !parse_finite(std::string(key))) return;
  const YamlValue& before = std::prev(at)->second;
  if (before.is_list() || before.is_map()) return;
  before.fail(fmt::format("{},{}", before.raw_text(), key),
              "a finite number, with a point in place of the comma");
}

std::optional<YamlValue> YamlMap::find(std::string_view key) const {
  for (const auto& [name, value] : entries_) {
    if (name == key) return value;
  }
  return std::nullopt;
}

YamlValue YamlMap::at(std::string_view key) const {
  if (const std::optional<YamlValue> value = find(key)) return *value;
  throw_bad_file(place_, fmt::format("the key {} is missing", key), "this key and its value");
}

YamlValue load_yaml(const std::filesystem::path& file) {
  return parse_yaml(file, read_file_bytes(file));
}

YamlValue parse_yaml(const std::filesystem::path& file, const std::string& text) {
  try {
    if (const int documents = count_documents(text); documents != 1) {
      throw_bad_file({file}, documents == 0 ? "no YAML document" : "several YAML documents", "one");
    }
    const YAML::Node document = YAML::Load(text);
    return {document, {file, line_of(document), ""}};
  } catch (const YAML::Exception& error) {
    if (const int line = indented_by_tab(text)) {
      throw_bad_file({file, line, ""}, "a tab in the indentation", "spaces");
    }
    throw_bad_file({file, error.mark.line + 1, ""}, error.msg, "valid YAML");
  }
}

}  // namespace berth
