#pragma once

#include <string>
#include <vector>

#include "tests/apps/command_scene.hpp"

namespace berth {

/// Expects exit status 1, no output, one line of message with all these parts, and no new file.
void expect_refused(const CommandScene& scene, const std::vector<std::string>& arguments,
                    const std::vector<std::string>& told);

}  // namespace berth
