#include "apps/berth/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/berth/arguments.hpp"
#include "apps/berth/command_pages.hpp"
#include "apps/berth/commands.hpp"
#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/files/edit_distance.hpp"

namespace berth::app {
namespace {

/// Shows what an option takes as the manual page does, without CLI11's checks of it.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = value_of(*option);
    return (value.empty() ? "" : " " + value) + (option->get_required() ? " REQUIRED" : "");
  }
};

/// Throws where the first word is no command and no option.
void require_command_named(const CLI::App& program, const std::string& word) {
  if (word.starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) names.push_back(command->get_name());
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw CLI::ValidationError(
      word, fmt::format("no such command; expected {} (the nearest), or another of {}",
                        nearest(word, known), fmt::join(known, ", ")));
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  CLI::App program(
      "berth: how far each link of a robot is from what depth cameras see, and from what they "
      "cannot "
      "see.\n"
      "Takes depth images, the robot's URDF and its joint angles; gives per link both distances "
      "with "
      "a certified\n"
      "lower bound, and the closest points.");
  // None at all is found below: CLI11 would report that before an unknown word.
  program.require_subcommand(0, 1);
  program.formatter(std::make_shared<HelpFormatter>());
  program.preparse_callback([&](std::size_t) {
    if (argc > 1) require_command_named(program, argv[1]);
  });
  program.set_version_flag("--version", BERTH_VERSION);
  std::vector<std::pair<CLI::App*, std::function<int()>>> commands;
  const auto add = [&]<class Arguments>(const char* name, const char* what,
                                        void (*add_options)(CLI::App&, Arguments&),
                                        void (*work)(const Arguments&)) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* const command = program.add_subcommand(name, what);
    add_options(*command, *arguments);
    commands.emplace_back(command, [arguments, work] {
      int threads = 0;
      if constexpr (requires { arguments->threads; }) threads = arguments->threads;
      return carry_out("berth", threads, [&] { work(*arguments); });
    });
  };
  add("demo", "Run the bundled scene: a table of links and distances, and pictures",
      add_demo_options, demo_command);
  add("run", "Run the frames of a scene through the whole pipeline", add_run_options, run_command);
  add("record", "Run a scene, and record what its monitor saw and said when it stopped the robot",
      add_record_options, record_command);
  add("replay", "Repeat a recording, and check that all results are the same", add_replay_options,
      replay_command);
  add("filter", "Write the robot's depth, its link IDs and the obstacles as images",
      add_filter_options, filter_command);
  add("calibrate", "Find the cameras' poses and settings from images of the moving arm",
      add_calibrate_options, calibrate_command);
  add("evaluate", "Compare images as the thesis does: three of them, or those of a scene",
      add_evaluate_options, evaluate_command);
  add("view", "Show a scene by a page: what is seen, filtered and hidden, and change its settings",
      add_view_options, view_command);
  add("init", "Write a scene to begin with, from the robot's URDF", add_init_options, init_command);
  add("doctor", "All checks of a scene: what is wrong, and what to do next, in order",
      add_doctor_options, doctor_command);
  add("schema",
      "The JSON Schema of scene files, of results or of calibrations, for editors and programs",
      add_schema_options, schema_command);
  // For installing, and nobody's own use.
  std::filesystem::path pages_folder;
  CLI::App* pages_command = program.add_subcommand("write-pages", "")->group("");
  pages_command->add_option("folder", pages_folder)->required();
  commands.emplace_back(pages_command, [&] {
    return carry_out("berth", 0, [&] { write_command_pages(program, pages_folder); });
  });
  program.footer(
      "Examples:\n  berth demo\n  berth init robot.urdf\n  berth doctor scene.yaml\n  berth run "
      "scene.yaml --picture pictures\nberth COMMAND --help shows all options.");

  const auto require_command = [&] {
    if (program.get_subcommands().empty()) throw CLI::RequiredError("A command");
  };
  if (const auto status = parse_command_line(program, argc, argv, require_command)) {
    return *status;
  }
  return std::ranges::find_if(commands, [](const auto& one) { return one.first->parsed(); })
      ->second();
}

}  // namespace berth::app
