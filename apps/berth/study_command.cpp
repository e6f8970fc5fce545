#include "apps/berth/study_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/berth/arguments.hpp"
#include "apps/berth/data_folders.hpp"
#include "apps/berth/interrupt.hpp"
#include "study/study.hpp"

namespace berth {

void add_study_options(CLI::App& command, StudyArguments& arguments) {
  command.add_flag("--quick", arguments.quick, "A thinned sweep of everything, less than a minute");
  command
      .add_option("--out", arguments.out_folder,
                  "Folder for index.html, figures and tables, made if it is not there; a study "
                  "that was stopped there goes on (default: berth_study)")
      ->type_name("DIR");
  command.add_option("--seed", arguments.seed, "Of the first of the drawn scenes (default: 1)")
      ->check(CLI::Range(0, 1000000000))
      ->type_name("N");
  command
      .add_option("--scene", arguments.scenes,
                  "A recording to measure on as well; may stand several times")
      ->type_name("SCENE.yaml");
  add_threads(command, arguments.threads);
  add_backend_options(command,
                      "opengl measures the methods on OpenGL as well, for figures 3.13 to 3.19",
                      arguments.where);
  command.footer("Example:\n  berth study --quick --out berth_study --scene scene.yaml");
}

void study_command(const StudyArguments& arguments) {
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  try {
    study::StudySettings settings{arguments.quick,
                                  arguments.seed,
                                  arguments.threads > 0 ? arguments.threads : processors,
                                  arguments.out_folder,
                                  bundled_scene_file(),
                                  arguments.scenes,
                                  study_scripts_folder(),
                                  {}};
    if (arguments.where.backend == Backend::opengl) settings.gl_device = arguments.where.gl_device;
    study::run_study(settings);
  } catch (const Interrupted&) {
    fmt::print(stderr, "berth: what is complete is kept in {}; the same command goes on there\n",
               arguments.out_folder.string());
    throw;
  }
}

}  // namespace berth
