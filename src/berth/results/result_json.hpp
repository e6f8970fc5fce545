#pragma once

#include <string>

#include "berth/pipeline/result.hpp"

namespace berth {

/// The result as one line of JSON, schema berth/result/3, without a line break at its end: the
/// fields of visit_fields(). Lengths in metres. What is not known is null. Every float can be read
/// back exactly and has few digits (0.1234; now and then more, where the JSON library prints those
/// of a double near it).
std::string result_json(const Result& result);

}  // namespace berth
