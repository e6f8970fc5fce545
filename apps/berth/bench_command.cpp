#include "apps/berth/bench_command.hpp"

#include "apps/berth/data_folders.hpp"
#include "bench/bench.hpp"

namespace berth {

void bench_command(const BenchArguments& arguments) {
  bench::BenchSettings settings;
  settings.quick = arguments.quick;
  settings.random_scenes = arguments.random_scenes;
  settings.out_folder = arguments.out_folder;
  settings.bundled_scene = bundled_scene_file();
  settings.scenes = arguments.scenes;
  if (arguments.where.backend == Backend::opengl) settings.gl_device = arguments.where.gl_device;
  bench::run_benchmarks(settings);
}

}  // namespace berth
