#include "bench/machine.hpp"

#include <embree3/rtcore_config.h>
#include <fcl/config.h>
#include <flann/config.h>
#include <fmt/format.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <fstream>
#include <nanoflann.hpp>
#include <thread>

#include "bench/instruction_set.hpp"

namespace berth::bench {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "not named by the system";
}

std::string compiler() {
#if defined(__clang__)
  return fmt::format("Clang {}", __clang_version__);
#else
  return fmt::format("GCC {}", __VERSION__);
#endif
}

}  // namespace

std::vector<std::string> describe_machine() {
  return {
      fmt::format("processor: {}, {} threads in hardware", processor_name(),
                  std::thread::hardware_concurrency()),
      fmt::format("instruction set: {}", best_instruction_set()),
      "times: of methods with one thread, its processor time; of the method with two threads, of "
      "stages and of meshes, by the clock on the wall",
      fmt::format("compiler: {}, {}", compiler(), BERTH_BENCH_BUILD),
      fmt::format("libraries: Highway {}, Embree {}, Eigen {}.{}.{}, TBB {}.{}, nanoflann {:x}, "
                  "FLANN {}, FCL "
                  "{}, OctoMap {}.{}.{}",
                  BERTH_BENCH_HIGHWAY, RTC_VERSION_STRING, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                  EIGEN_MINOR_VERSION, TBB_VERSION_MAJOR, TBB_VERSION_MINOR, NANOFLANN_VERSION,
                  FLANN_VERSION_, FCL_VERSION, OCTOMAP_MAJOR_VERSION, OCTOMAP_MINOR_VERSION,
                  OCTOMAP_PATCH_VERSION),
      fmt::format("commit: {}", BERTH_BENCH_COMMIT),
  };
}

}  // namespace berth::bench
