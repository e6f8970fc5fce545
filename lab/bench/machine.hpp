#pragma once

#include <string>
#include <vector>

namespace berth::lab {

/// What the figures depend on, one "name: value" a line: processor, instruction set, threads,
/// compiler, libraries, commit.
std::vector<std::string> describe_machine();

}  // namespace berth::lab
