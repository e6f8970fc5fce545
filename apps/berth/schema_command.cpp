// schema: what files and lines of JSON may be.
#include <fmt/format.h>

#include "apps/berth/commands.hpp"
#include "berth/reports/calibration_report.hpp"
#include "berth/scene/scene_schema.hpp"
#include "thesis/image_output.hpp"

namespace berth::app {

void schema_command(const SchemaArguments& arguments) {
  fmt::print("{}", arguments.name == "scene"    ? scene_schema()
                   : arguments.name == "result" ? schema_of_all_results()
                                                : calibration_schema());
}

}  // namespace berth::app
