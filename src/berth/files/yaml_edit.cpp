#include "berth/files/yaml_edit.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "berth/files/error.hpp"
#include "berth/files/number.hpp"

namespace berth {
namespace {

bool is_flow(const YAML::Node& node) { return node.Style() == YAML::EmitterStyle::Flow; }

void add_scalars(const YAML::Node& node, YamlPath& path, YamlScalars& scalars) {
  const auto add_item = [&](const std::string& step, const YAML::Node& item) {
    path.push_back(step);
    add_scalars(item, path, scalars);
    path.pop_back();
  };
  if (node.IsScalar()) scalars[path] = node.Scalar();
  if (node.IsMap()) {
    for (const auto& entry : node) add_item(entry.first.Scalar(), entry.second);
  }
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) add_item(std::to_string(i), node[i]);
  }
}

/// The entry of a map or a list; one that is not defined where there is none.
YAML::Node entry_of(const YAML::Node& node, const std::string& step) {
  if (node.IsMap()) return node[step];
  const std::optional<int> place = parse_integer(step);
  if (node.IsSequence() && place && *place >= 0) return node[static_cast<std::size_t>(*place)];
  return YAML::Node(YAML::NodeType::Undefined);
}

/// The last value on the way from `from` along the path, and how many of its steps are behind it.
std::pair<YAML::Node, std::size_t> find_value(const YAML::Node& from, const YamlPath& path,
                                              std::size_t steps = 0) {
  if (steps == path.size()) return {from, steps};
  const YAML::Node next = entry_of(from, path[steps]);
  return next.IsDefined() ? find_value(next, path, steps + 1) : std::pair{from, steps};
}

FilePlace place_of(const std::filesystem::path& file, const YAML::Node& document,
                   const YamlPath& path) {
  std::string where;
  for (const std::string& step : path) {
    if (parse_integer(step)) {
      where += fmt::format("[{}]", step);
    } else {
      where += (where.empty() ? "" : ".") + step;
    }
  }
  return {file, find_value(document, path).first.Mark().line + 1, where};
}

/// Where the value itself begins, behind its anchor and its tag.
std::size_t begin_of(std::string_view text, const YAML::Node& node) {
  std::size_t begin = std::min(static_cast<std::size_t>(node.Mark().pos), text.size());
  while (begin < text.size() && (text[begin] == '&' || text[begin] == '!')) {
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    begin = std::min(text.find_first_not_of(" \t", end), text.size());
  }
  return begin;
}

/// The part of a text from its first byte, a quote, to the one that closes it.
std::string_view quoted_part(std::string_view text) {
  const char quote = text.front();
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool escapes = quote == '"' ? text[i] == '\\' : text.substr(i, 2) == "''";
    if (escapes) {
      ++i;
    } else if (text[i] == quote) {
      return text.substr(0, i + 1);
    }
  }
  return {};
}

/// A scalar as it stands in the text, with its quotes; none where it is in block style, or goes
/// over several lines without quotes.
std::optional<std::string_view> written_scalar(std::string_view text, const YAML::Node& scalar) {
  const std::string_view rest = text.substr(begin_of(text, scalar));
  if (rest.starts_with('"') || rest.starts_with('\'')) {
    const std::string_view quoted = quoted_part(rest);
    return quoted.empty() ? std::nullopt : std::optional(quoted);
  }
  if (!rest.starts_with(scalar.Scalar())) return std::nullopt;
  return rest.substr(0, scalar.Scalar().size());
}

/// A scalar that may stand in a flow list; in the same quotes as `like`.
std::string scalar_as_yaml(const std::string& value, std::string_view like = {}) {
  YAML::Emitter list;
  list << YAML::Flow << YAML::BeginSeq;
  if (like.starts_with('\'')) list << YAML::SingleQuoted;
  if (like.starts_with('"')) list << YAML::DoubleQuoted;
  list << value << YAML::EndSeq;
  return std::string(list.c_str() + 1, list.size() - 2);
}

std::string with_replaced(const std::filesystem::path& file, const std::string& text,
                          const YamlScalars& values) {
  const YAML::Node document = YAML::Load(text);
  std::map<std::size_t, std::pair<std::size_t, std::string>> replacements;  // begin: size, new text
  for (const auto& [path, value] : values) {
    const auto [node, steps] = find_value(document, path);
    if (steps < path.size()) continue;
    const auto written = node.IsScalar() ? written_scalar(text, node) : std::nullopt;
    if (!written) {
      throw_bad_file(place_of(file, document, path), "is written in a way that cannot be edited",
                     "a value on one line");
    }
    replacements[static_cast<std::size_t>(written->data() - text.data())] = {
        written->size(), scalar_as_yaml(value, *written)};
  }
  std::string result;
  std::size_t done = 0;
  for (const auto& [begin, replacement] : replacements) {
    result += text.substr(done, begin - done) + replacement.second;
    done = begin + replacement.first;
  }
  return result + text.substr(done);
}

std::string_view line_break_of(std::string_view text) {
  const std::size_t end = text.find('\n');
  return end != 0 && end != std::string_view::npos && text[end - 1] == '\r' ? "\r\n" : "\n";
}

/// The end of the line that `from` is in, and of the comments below that are indented by more than
/// `column`: they belong to that line.
std::size_t end_of_line(std::string_view text, std::size_t from, std::size_t column) {
  while (true) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::size_t next = text.find_first_not_of(' ', end + 1);
    if (next == std::string_view::npos || text[next] != '#' || next - (end + 1) <= column) {
      return end < text.size() && text[end - 1] == '\r' ? end - 1 : end;
    }
    from = next;
  }
}

/// Puts "key: value" into a map: behind its last entry that is a scalar, else in front of all.
/// Returns false where the map is written in a way that cannot be edited.
bool insert_entry(std::string& text, const YAML::Node& map, const std::string& entry) {
  std::size_t column = 0;
  std::optional<std::size_t> behind;
  for (const auto& item : map) {
    const YAML::Node& key = item.first;
    const YAML::Node& value = item.second;
    // An alias has the mark of what it stands for, which is earlier.
    if (!value.IsScalar() || value.Mark().pos < key.Mark().pos) continue;
    if (const auto written = written_scalar(text, value)) {
      behind = static_cast<std::size_t>(written->data() + written->size() - text.data());
      column = static_cast<std::size_t>(key.Mark().column);
    }
  }
  if (behind && is_flow(map)) {
    text.insert(*behind, ", " + entry);
  } else if (behind) {
    const std::string line = std::string(line_break_of(text)) + std::string(column, ' ') + entry;
    text.insert(end_of_line(text, *behind, column), line);
  } else if (map.size() == 0) {
    const std::size_t begin = begin_of(text, map);
    if (text.substr(begin, 1) != "{") return false;
    text.insert(begin + 1, entry);
  } else {
    const YAML::Node first = map.begin()->first;
    const std::string indentation(static_cast<std::size_t>(first.Mark().column), ' ');
    text.insert(begin_of(text, first),
                entry + (is_flow(map) ? ", " : std::string(line_break_of(text)) + indentation));
  }
  return true;
}

void insert_value(const std::filesystem::path& file, const YamlPath& path, const std::string& value,
                  std::string& text) {
  const YAML::Node document = YAML::Load(text);
  const auto [map, steps] = find_value(document, path);
  std::string entry = scalar_as_yaml(value);
  for (std::size_t i = path.size(); i-- > steps;) {
    const bool is_map = i + 1 < path.size();
    entry = fmt::format("{}: {}{}{}", scalar_as_yaml(path[i]), is_map ? "{" : "", entry,
                        is_map ? "}" : "");
  }
  if (!map.IsMap() || !insert_entry(text, map, entry)) {
    throw_bad_file(place_of(file, document, path), "cannot be added here",
                   "a map of keys and values");
  }
}

/// Puts an item in front of a list's others. Returns false where the list is written in a way that
/// cannot be edited.
bool insert_first(std::string& text, const YAML::Node& list, const std::string& item) {
  if (!list.IsSequence()) return false;
  const std::size_t begin = begin_of(text, list);
  if (text.substr(begin, 1) == "[") {
    text.insert(begin + 1, list.size() == 0 ? item : item + ", ");
    return true;
  }
  const std::size_t dash = text.rfind('-', begin_of(text, list[0]));
  if (list.size() == 0 || dash == std::string::npos) return false;
  const std::size_t line = text.rfind('\n', dash);
  const std::size_t column = dash - (line == std::string::npos ? 0 : line + 1);
  text.insert(dash, "- " + item + std::string(line_break_of(text)) + std::string(column, ' '));
  return true;
}

/// Throws unless the new text has these values and no others.
void require_values(const std::filesystem::path& file, const std::string& old_text,
                    const std::string& new_text, const YamlScalars& expected) {
  const YamlScalars found = yaml_scalars(new_text);
  if (found == expected) return;
  const auto fail = [&](const YamlPath& path, const std::string& what, const std::string& value) {
    throw_bad_file(place_of(file, YAML::Load(old_text), path), what,
                   value + "; an alias cannot be edited, write out what it stands for");
  };
  for (const auto& [path, value] : expected) {
    const auto at = found.find(path);
    if (at == found.end()) fail(path, "would be lost", value);
    if (at->second != value) fail(path, "would become " + at->second, value);
  }
  for (const auto& [path, value] : found) {
    if (!expected.contains(path)) fail(path, "would become " + value, "no such key");
  }
}

/// All of the old text, with `values`.
YamlScalars scalars_with(const std::string& old_text, const YamlScalars& values) {
  YamlScalars scalars = yaml_scalars(old_text);
  for (const auto& [path, value] : values) scalars[path] = value;
  return scalars;
}

/// All of the old text, where the list `key` has one item more in front.
YamlScalars scalars_with_first(const std::string& old_text, const std::string& key,
                               const std::vector<std::pair<std::string, std::string>>& item) {
  YamlScalars scalars;
  for (const auto& [path, value] : yaml_scalars(old_text)) {
    YamlPath moved = path;
    if (path.size() > 1 && path[0] == key) moved[1] = std::to_string(std::stoi(path[1]) + 1);
    scalars[moved] = value;
  }
  for (const auto& [name, value] : item) scalars[{key, "0", name}] = value;
  return scalars;
}

/// As a YAML text whose bytes yaml-cpp counts, which is from behind its byte order mark on.
template <class Edit>
std::string edited_behind_mark(const std::filesystem::path& file, const std::string& text,
                               const Edit& edit) {
  const std::string mark = text.starts_with("\xEF\xBB\xBF") ? "\xEF\xBB\xBF" : "";
  try {
    return mark + edit(text.substr(mark.size()));
  } catch (const YAML::Exception& error) {
    throw_bad_file({file, error.mark.line + 1}, "cannot be edited: " + error.msg,
                   "YAML without rare forms");
  }
}

}  // namespace

YamlScalars yaml_scalars(const std::string& text) {
  YamlScalars scalars;
  YamlPath path;
  add_scalars(YAML::Load(text), path, scalars);
  return scalars;
}

std::string edited_yaml(const std::filesystem::path& file, const std::string& whole,
                        const YamlScalars& values) {
  return edited_behind_mark(file, whole, [&](const std::string& text) {
    std::string result = with_replaced(file, text, values);
    const YamlScalars old = yaml_scalars(text);
    for (const auto& [path, value] : values) {
      if (!old.contains(path)) insert_value(file, path, value, result);
    }
    require_values(file, text, result, scalars_with(text, values));
    return result;
  });
}

std::string with_list_item(const std::filesystem::path& file, const std::string& whole,
                           const std::string& key,
                           const std::vector<std::pair<std::string, std::string>>& item) {
  return edited_behind_mark(file, whole, [&](const std::string& text) {
    std::string entry;
    for (const auto& [name, value] : item) {
      entry += fmt::format("{}{}: {}", entry.empty() ? "" : ", ", scalar_as_yaml(name),
                           scalar_as_yaml(value));
    }
    entry = "{" + entry + "}";
    const YAML::Node document = YAML::Load(text);
    const YAML::Node list = document[key];
    std::string result = text;
    const bool is_done = list.IsDefined()
                             ? insert_first(result, list, entry)
                             : insert_entry(result, document, fmt::format("{}: [{}]", key, entry));
    if (!is_done) {
      throw_bad_file(place_of(file, document, {key}), "cannot be added to", "a list of items");
    }
    require_values(file, text, result, scalars_with_first(text, key, item));
    return result;
  });
}

}  // namespace berth
