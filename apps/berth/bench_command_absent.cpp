// In place of bench_command.cpp where the methods to compare with are not installed.
#include <stdexcept>

#include "apps/berth/bench_command.hpp"

namespace berth {

void bench_command(const BenchArguments&) {
  throw std::runtime_error(
      "this program was built without benchmarks; `make bench` in berth's source tree installs "
      "what they need, builds and runs them");
}

}  // namespace berth
