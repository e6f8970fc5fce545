#include "apps/berth/bench_command.hpp"

#include "apps/berth/data_folders.hpp"
#include "bench/bench.hpp"

namespace berth {

void bench_command(const BenchArguments& arguments) {
  bench::run_benchmarks({arguments.quick, arguments.random_scenes, arguments.out_folder,
                         bundled_scene_file(), arguments.scenes});
}

}  // namespace berth
