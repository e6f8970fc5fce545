#include "lab/measure/machine.hpp"

#include <fmt/format.h>

#include <fstream>
#include <thread>

namespace berth::lab {
namespace {

std::string model_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "not named by the system";
}

}  // namespace

std::string processor_name() {
  return fmt::format("{}, {} threads in hardware", model_name(),
                     std::thread::hardware_concurrency());
}

std::string compiler_name() {
#if defined(__clang__)
  return fmt::format("Clang {}, {}", __clang_version__, BERTH_BUILD);
#else
  return fmt::format("GCC {}, {}", __VERSION__, BERTH_BUILD);
#endif
}

std::string commit_name() { return BERTH_COMMIT; }

}  // namespace berth::lab
