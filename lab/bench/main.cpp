// berth_bench: measures berth beside what else a user could take.
#include <CLI/CLI.hpp>

#include "apps/support/command_options.hpp"
#include "apps/support/data_folders.hpp"
#include "apps/support/program.hpp"
#include "lab/bench/bench.hpp"

namespace {

using berth::BackendChoice;
using berth::lab::BenchSettings;

void add_options(CLI::App& program, BenchSettings& settings, BackendChoice& where) {
  program.add_flag("--quick", settings.quick, "A thinned run of less than half a minute");
  program
      .add_option("--random-scenes", settings.random_scenes,
                  "Number of random scenes where the run is not thinned (default: 200)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  program
      .add_option("--whole-robot-scenes", settings.whole_robot_scenes,
                  "The same for the method mesh with several cameras (default: 100)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  program.add_flag("--whole-robot", settings.whole_robot_alone,
                   "Only the method mesh with several cameras");
  program
      .add_option(
          "--out", settings.out_folder,
          "Folder for results.md and bench.csv, whole_robot.md and whole_robot.csv; made if "
          "it is not there")
      ->type_name("DIR");
  program
      .add_option("--scene", settings.scenes,
                  "A recording to measure as well; may stand several times")
      ->type_name("SCENE.yaml");
  berth::app::add_backend_options(
      program, "Which methods to measure: those of the processor, or those on OpenGL", where);
  program.footer("Example:\n  berth_bench --quick --out bench_results --scene scene.yaml");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Measures berth beside what else a user could take");
  BenchSettings settings;
  BackendChoice where;
  add_options(program, settings, where);
  if (const auto status = berth::app::parse_command_line(program, argc, argv)) return *status;
  return berth::app::carry_out("berth_bench", 0, [&] {
    settings.bundled_scene = berth::app::bundled_one_camera_file();
    if (where.backend == berth::Backend::opengl) settings.gl_device = where.gl_device;
    berth::lab::run_benchmarks(settings);
  });
}
