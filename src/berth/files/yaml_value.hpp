// Values of a YAML file that know where they stand, so that every complaint names
// the file, the line, the key and the value.
#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "berth/files/error.hpp"

namespace berth {

/// Each reader throws std::runtime_error where the value is of another type or outside its domain.
class YamlValue {
 public:
  YamlValue(const YAML::Node& node, FilePlace place) : node_(node), place_(std::move(place)) {}

  std::string text() const;      ///< not empty
  std::string raw_text() const;  ///< may be empty
  std::string one_of(const std::vector<std::string_view>& choices) const;
  /// A path that is relative to the YAML file's folder.
  std::filesystem::path path() const;
  bool boolean() const;
  int count() const;            ///< a whole number, 0 or more
  double number() const;        ///< finite, as all numbers here
  double positive() const;      ///< above 0
  double non_negative() const;  ///< 0 or more
  std::vector<double> numbers() const;
  std::vector<double> numbers(std::size_t how_many) const;
  std::vector<std::string> texts() const;

  bool is_list() const { return node_.IsSequence(); }
  bool is_map() const { return node_.IsMap(); }
  std::vector<YamlValue> list() const;
  /// Keys and values of a map in the file's order; a key that stands there twice is refused.
  std::vector<std::pair<std::string, YamlValue>> entries() const;

  const FilePlace& place() const { return place_; }
  /// Complains about the value itself, or about `found`.
  [[noreturn]] void fail(std::string_view expected) const;
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const;

 private:
  YAML::Node node_;
  FilePlace place_;
};

/// A map whose keys are looked up by name.
class YamlMap {
 public:
  explicit YamlMap(const YamlValue& value) : place_(value.place()), entries_(value.entries()) {}
  /// Refuses every key that is in neither list, and names the nearest `known` one.
  YamlMap(const YamlValue& value, const std::vector<std::string_view>& known,
          const std::vector<std::string_view>& unspoken = {});

  std::optional<YamlValue> find(std::string_view key) const;
  /// Throws where the key is missing.
  YamlValue at(std::string_view key) const;

  /// Sets `out` to what `how` makes of the key's value; leaves it where the key is missing.
  template <typename T>
  void read(std::string_view key, T (YamlValue::*how)() const, T& out) const {
    if (const std::optional<YamlValue> value = find(key)) out = ((*value).*how)();
  }

  const FilePlace& place() const { return place_; }

 private:
  /// In a map in braces `range_m: 1,5` is two entries: throws where this key is the part behind a
  /// decimal comma.
  void require_no_comma(std::string_view key) const;

  FilePlace place_;
  std::vector<std::pair<std::string, YamlValue>> entries_;
};

/// The one document of a YAML file. Throws where the file is missing, empty or breaks YAML's
/// grammar.
YamlValue load_yaml(const std::filesystem::path& file);

/// The same for a text that is, or will be, the content of `file`.
YamlValue parse_yaml(const std::filesystem::path& file, const std::string& text);

}  // namespace berth
