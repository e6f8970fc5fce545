#include "lab/bench/machine.hpp"

#include <embree3/rtcore_config.h>
#include <fcl/config.h>
#include <flann/config.h>
#include <fmt/format.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <nanoflann.hpp>

#include "lab/measure/instruction_set.hpp"
#include "lab/measure/machine.hpp"

namespace berth::lab {
std::vector<std::string> describe_machine() {
  return {
      fmt::format("processor: {}", processor_name()),
      fmt::format("instruction set: {}", best_instruction_set()),
      "times: of methods with one thread, its processor time; of the method with two threads, of "
      "stages and of meshes, by the clock on the wall",
      fmt::format("compiler: {}", compiler_name()),
      fmt::format("libraries: Highway {}, Embree {}, Eigen {}.{}.{}, TBB {}.{}, nanoflann {:x}, "
                  "FLANN {}, FCL "
                  "{}, OctoMap {}.{}.{}",
                  BERTH_BENCH_HIGHWAY, RTC_VERSION_STRING, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                  EIGEN_MINOR_VERSION, TBB_VERSION_MAJOR, TBB_VERSION_MINOR, NANOFLANN_VERSION,
                  FLANN_VERSION_, FCL_VERSION, OCTOMAP_MAJOR_VERSION, OCTOMAP_MINOR_VERSION,
                  OCTOMAP_PATCH_VERSION),
      fmt::format("commit: {}", commit_name()),
  };
}

}  // namespace berth::lab
