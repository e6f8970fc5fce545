// New values in a YAML text that otherwise stays as its author wrote it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace berth {

/// The way to a value: keys of maps, and places in lists as whole numbers from 0, such as
/// {"cameras", "0", "name"}.
using YamlPath = std::vector<std::string>;

/// Texts of scalars, without their quotes, by where they stand. An alias counts as what it stands
/// for.
using YamlScalars = std::map<YamlPath, std::string>;

/// All scalars of a document. `text` is one that load_yaml takes.
YamlScalars yaml_scalars(const std::string& text);

/// `text` with `values` in place of what stands at their paths. Keys that are missing are added to
/// their map; a missing map is added with them. Every other byte stays: comments, order, line ends.
/// The result was read again: it has exactly these values, and all others as before. Throws
/// std::runtime_error with file, line, path and what was expected where that cannot be, as with an
/// alias that would change too. `text` is the content of `file`, and one that load_yaml takes.
std::string edited_yaml(const std::filesystem::path& file, const std::string& text,
                        const YamlScalars& values);

/// `text` with a map of these keys and values as one more item, in front of the others, of the list
/// `key` of the document; the list is added where it is missing. Every other byte stays. Checks and
/// throws as edited_yaml does.
std::string with_list_item(const std::filesystem::path& file, const std::string& text,
                           const std::string& key,
                           const std::vector<std::pair<std::string, std::string>>& item);

}  // namespace berth
