// Inside berth only: parts of JSON Schemas (draft 2020-12).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace berth {

using Json = nlohmann::ordered_json;

namespace schema {

inline Json number() { return {{"type", "number"}}; }
inline Json number_or_null() { return {{"type", {"number", "null"}}}; }
/// A whole number, 0 or more.
inline Json count() { return {{"type", "integer"}, {"minimum", 0}}; }
inline Json text() { return {{"type", "string"}}; }
inline Json text_or_null() { return {{"type", {"string", "null"}}}; }
inline Json or_null(const Json& schema) { return {{"anyOf", {schema, {{"type", "null"}}}}}; }

inline Json list_of(const Json& item) { return {{"type", "array"}, {"items", item}}; }
inline Json list_of(const Json& item, int length) {
  return {{"type", "array"}, {"items", item}, {"minItems", length}, {"maxItems", length}};
}

/// A map that has no other keys than these.
inline Json map_of(const Json& keys, const std::vector<std::string>& required) {
  Json map{{"type", "object"}, {"properties", keys}};
  if (!required.empty()) map["required"] = required;
  map["additionalProperties"] = false;
  return map;
}
/// The same where all of `always` have to be there.
inline Json map_with(const Json& always, const Json& keys) {
  std::vector<std::string> names;
  for (const auto& [name, schema] : always.items()) names.push_back(name);
  return map_of(keys, names);
}
/// The same where all keys have to be there.
inline Json map_of_all(const Json& keys) { return map_with(keys, keys); }

/// With a sentence for people before it.
inline Json told(std::string_view sentence, const Json& schema) {
  Json all{{"description", sentence}};
  all.update(schema);
  return all;
}

/// A whole schema as text. `name` is unique among berth's.
inline std::string text_of(std::string_view name, std::string_view title, std::string_view sentence,
                           const Json& schema) {
  Json all{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
           {"$id", "urn:berth:" + std::string(name)},
           {"title", title},
           {"description", sentence}};
  all.update(schema);
  return all.dump(2) + "\n";
}

}  // namespace schema
}  // namespace berth
