#pragma once

#include <string>

namespace berth {

/// What a line of result_json() may be, schema berth/result/3, as JSON Schema (draft 2020-12), in
/// lines: the fields of visit_fields() with their sentences, and which of them every line has.
std::string result_schema();

}  // namespace berth
