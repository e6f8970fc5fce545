#pragma once

#include <string>

namespace berth {

/// What calibration_json() writes, schema berth/calibration/1, as JSON Schema (draft 2020-12), in
/// lines.
std::string calibration_schema();

}  // namespace berth
