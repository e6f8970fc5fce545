// What measurements depend on, each in words for a table's head.
#pragma once

#include <string>

namespace berth::lab {

/// As the system names it, with the number of its threads.
std::string processor_name();
/// With the kind of the build.
std::string compiler_name();
/// Of the source tree when the build was configured; "-dirty" behind it where files differed.
std::string commit_name();

}  // namespace berth::lab
