#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "berth/pipeline/result.hpp"

namespace berth {

/// What lines of another command have besides.
struct MoreOfResults {
  /// Properties that a line or a link of it may have.
  nlohmann::ordered_json of_line = nlohmann::ordered_json::object();
  nlohmann::ordered_json of_link = nlohmann::ordered_json::object();
  /// What `method` may be.
  nlohmann::ordered_json methods = {kMethodName};
};

/// What a line of result_json() may be, schema berth/result/3, as JSON Schema (draft 2020-12), in
/// lines: the fields of visit_fields() with their sentences, and which of them every line has.
std::string result_schema(const MoreOfResults& more = {});

}  // namespace berth
