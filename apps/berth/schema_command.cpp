// schema: what files and lines of JSON may be.
#include <fmt/format.h>

#include "apps/berth/commands.hpp"
#include "berth/reports/calibration_schema.hpp"
#include "berth/results/result_schema.hpp"
#include "berth/scene/scene_schema.hpp"

namespace berth::app {

void schema_command(const SchemaArguments& arguments) {
  fmt::print("{}", arguments.name == "scene"    ? scene_schema()
                   : arguments.name == "result" ? result_schema()
                                                : calibration_schema());
}

}  // namespace berth::app
