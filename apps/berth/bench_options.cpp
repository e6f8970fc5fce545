#include "apps/berth/bench_command.hpp"

namespace berth {

void add_bench_options(CLI::App& command, BenchArguments& arguments) {
  command.add_flag("--quick", arguments.quick, "A thinned run of less than half a minute");
  command
      .add_option("--random-scenes", arguments.random_scenes,
                  "Number of random scenes where the run is not thinned (default: 200)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  command
      .add_option("--out", arguments.out_folder,
                  "Folder for results.md and bench.csv; made if it is not there")
      ->type_name("DIR");
  command
      .add_option("--scene", arguments.scenes,
                  "A recording to measure as well; may stand several times")
      ->type_name("SCENE.yaml");
  add_backend_options(command,
                      "Which methods to measure: those of the processor, or those on OpenGL",
                      arguments.where);
  command.footer("Example:\n  berth bench --quick --out bench_results --scene scene.yaml");
}

}  // namespace berth
