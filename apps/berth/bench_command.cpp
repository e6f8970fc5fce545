#include "apps/berth/bench_command.hpp"

#include "bench/bench.hpp"

namespace berth {

void bench_command(const BenchArguments& arguments) {
  bench::run_benchmarks({arguments.quick, arguments.random_scenes, arguments.out_folder,
                         BERTH_BUNDLED_SCENE "/scene.yaml", arguments.scenes});
}

}  // namespace berth
