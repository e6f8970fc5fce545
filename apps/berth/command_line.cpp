#include "apps/berth/command_line.hpp"

#include <CLI/CLI.hpp>

#include "apps/berth/arguments.hpp"
#include "apps/berth/command_pages.hpp"
#include "apps/berth/commands.hpp"
#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"

namespace berth::app {

int run_command_line(int argc, const char* const* argv) {
  CLI::App program(
      "berth: how far each link of a robot is from the nearest thing that a depth camera sees.\n"
      "Takes depth images, the robot's URDF and its joint angles; gives per link the least "
      "distance, the two\n"
      "closest points and the mean direction of what is near. What an obstacle hides counts as "
      "obstacle.");
  // None at all is found below: CLI11 would report that before an unknown word.
  program.require_subcommand(0, 1);
  program.set_version_flag("--version", BERTH_VERSION);
  DemoArguments demo;
  RunArguments run;
  RecordArguments record;
  ReplayArguments replay;
  FilterArguments filter;
  CalibrateArguments calibrate;
  EvaluateArguments evaluate;
  ViewArguments view;
  InitArguments init;
  DoctorArguments doctor;
  SchemaArguments schema;
  std::filesystem::path pages_folder;
  CLI::App* demo_command = program.add_subcommand(
      "demo", "Run the bundled scene: a table of links and distances, and pictures");
  CLI::App* run_command =
      program.add_subcommand("run", "Run the frames of a scene through the whole pipeline");
  CLI::App* record_command = program.add_subcommand(
      "record", "Run a scene, and record what its monitor saw and said when it stopped the robot");
  CLI::App* replay_command = program.add_subcommand(
      "replay", "Do once more what was recorded, and tell whether the results are the same");
  CLI::App* filter_command = program.add_subcommand(
      "filter", "Write the robot's depth, its link IDs and the obstacles as images");
  CLI::App* calibrate_command = program.add_subcommand(
      "calibrate", "Find the cameras' poses and settings from images of the moving arm");
  CLI::App* evaluate_command = program.add_subcommand(
      "evaluate", "Compare images as the thesis does: three of them, or those of a scene");
  CLI::App* view_command = program.add_subcommand(
      "view", "Show a scene by a page: what is seen, filtered and hidden, and change its settings");
  CLI::App* init_command =
      program.add_subcommand("init", "Write a scene to begin with, from the robot's URDF");
  CLI::App* doctor_command = program.add_subcommand(
      "doctor", "All checks of a scene: what is wrong, and what to do next, in order");
  CLI::App* schema_command = program.add_subcommand(
      "schema",
      "The JSON Schema of scene files, of results or of calibrations, for editors and programs");
  // For installing, and nobody's own use.
  CLI::App* pages_command = program.add_subcommand("write-pages", "")->group("");
  pages_command->add_option("folder", pages_folder)->required();
  add_init_options(*init_command, init);
  add_doctor_options(*doctor_command, doctor);
  add_schema_options(*schema_command, schema);
  add_demo_options(*demo_command, demo);
  add_run_options(*run_command, run);
  add_record_options(*record_command, record);
  add_replay_options(*replay_command, replay);
  add_filter_options(*filter_command, filter);
  add_calibrate_options(*calibrate_command, calibrate);
  add_evaluate_options(*evaluate_command, evaluate);
  add_view_options(*view_command, view);
  program.footer(
      "Examples:\n  berth demo\n  berth init robot.urdf\n  berth doctor scene.yaml\n  berth run "
      "scene.yaml --picture pictures\nberth COMMAND --help tells more.");

  const auto require_command = [&] {
    if (program.get_subcommands().empty()) throw CLI::RequiredError("A command");
  };
  if (const auto status = parse_command_line(program, argc, argv, require_command)) {
    return *status;
  }
  const auto carry_out = [](int threads, const auto& command) {
    return app::carry_out("berth", threads, command);
  };
  if (*demo_command) return carry_out(demo.threads, [&] { app::demo_command(demo); });
  if (*run_command) return carry_out(run.threads, [&] { app::run_command(run); });
  if (*record_command) return carry_out(record.threads, [&] { app::record_command(record); });
  if (*replay_command) return carry_out(replay.threads, [&] { app::replay_command(replay); });
  if (*filter_command) return carry_out(filter.threads, [&] { app::filter_command(filter); });
  if (*calibrate_command) {
    return carry_out(calibrate.threads, [&] { app::calibrate_command(calibrate); });
  }
  if (*init_command) return carry_out(0, [&] { app::init_command(init); });
  if (*doctor_command) return carry_out(doctor.threads, [&] { app::doctor_command(doctor); });
  if (*schema_command) return carry_out(0, [&] { app::schema_command(schema); });
  if (*pages_command) return carry_out(0, [&] { write_command_pages(program, pages_folder); });
  if (*view_command) return carry_out(view.threads, [&] { app::view_command(view); });
  return carry_out(evaluate.threads, [&] { app::evaluate_command(evaluate); });
}

}  // namespace berth::app
