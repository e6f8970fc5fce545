#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lab/closed_loop/supervisor.hpp"

namespace berth::lab {

/// A way to supervise the arm, by the name that it has in tables and on the command line.
struct Policy {
  std::string name;
  std::string sentence;
};

const std::vector<Policy>& all_policies();

/// One for each encounter. Throws std::invalid_argument for an unknown name.
std::unique_ptr<Supervisor> make_supervisor(const std::string& name, double request_hz);

}  // namespace berth::lab
