// berth_study: makes the experiments of the thesis again.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "apps/support/command_options.hpp"
#include "apps/support/data_folders.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/program.hpp"
#include "thesis/study/study.hpp"

namespace {

using berth::BackendChoice;
using berth::lab::StudySettings;

void add_options(CLI::App& program, StudySettings& settings, BackendChoice& where) {
  program.add_flag("--quick", settings.quick, "A thinned sweep of everything, less than a minute");
  program
      .add_option("--out", settings.out_folder,
                  "Folder for index.html, figures and tables, made if it is not there; a study "
                  "that was stopped there goes on (default: berth_study)")
      ->type_name("DIR");
  program.add_option("--seed", settings.seed, "Of the first of the drawn scenes (default: 1)")
      ->check(CLI::Range(0, 1000000000))
      ->type_name("N");
  program
      .add_option("--scene", settings.scenes,
                  "A recording to measure on as well; may stand several times")
      ->type_name("SCENE.yaml");
  berth::app::add_threads(program, settings.threads);
  berth::app::add_backend_options(
      program, "opengl measures the methods on OpenGL as well, for figures 3.13 to 3.19", where);
  program.footer("Example:\n  berth_study --quick --out study --scene scene.yaml");
}

void run(StudySettings settings, const BackendChoice& where) {
  if (settings.threads == 0) {
    settings.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
  settings.bundled_scene = berth::app::bundled_one_camera_file();
  if (where.backend == berth::Backend::opengl) settings.gl_device = where.gl_device;
  try {
    berth::lab::run_study(settings);
  } catch (const berth::app::Interrupted&) {
    fmt::print(stderr,
               "berth_study: what is complete is kept in {}; the same command goes on there\n",
               settings.out_folder.string());
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Makes the experiments of the thesis again: figures and a page");
  StudySettings settings;
  settings.threads = 0;
  settings.out_folder = "berth_study";
  settings.scripts_folder = BERTH_STUDY_SCRIPTS;
  BackendChoice where;
  add_options(program, settings, where);
  if (const auto status = berth::app::parse_command_line(program, argc, argv)) return *status;
  return berth::app::carry_out("berth_study", settings.threads, [&] { run(settings, where); });
}
