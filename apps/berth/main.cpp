#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <optional>

#include "apps/berth/arguments.hpp"
#include "apps/berth/bench_command.hpp"
#include "apps/berth/commands.hpp"
#include "apps/berth/interrupt.hpp"
#include "apps/berth/study_command.hpp"

namespace {

constexpr int kDone = 0;
constexpr int kCouldNot = 1;
constexpr int kWrongUsage = 2;
constexpr int kInterrupted = 130;

int carry_out(int threads, const std::function<void()>& command) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
  berth::note_interrupts();
  try {
    command();
    return kDone;
  } catch (const berth::Interrupted&) {
    fmt::print(stderr, "berth: interrupted\n");
    return kInterrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "berth: {}\n", error.what());
    return kCouldNot;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "berth: how far each link of a robot is from the nearest thing that a depth camera sees.\n"
      "Takes depth images, the robot's URDF and its joint angles; gives per link the least "
      "distance, the two\n"
      "closest points and the mean direction of what is near. What an obstacle hides counts as "
      "obstacle.");
  // None at all is found below: CLI11 would tell of that before it tells of an unknown word.
  app.require_subcommand(0, 1);
  app.failure_message(CLI::FailureMessage::simple);
  app.set_version_flag("--version", BERTH_VERSION);
  berth::DemoArguments demo;
  berth::RunArguments run;
  berth::FilterArguments filter;
  berth::EvaluateArguments evaluate;
  berth::BenchArguments bench;
  berth::StudyArguments study;
  CLI::App* demo_app = app.add_subcommand(
      "demo", "Run the bundled scene: a table of links and distances, and pictures");
  CLI::App* run_app =
      app.add_subcommand("run", "Run the frames of a scene through the whole pipeline");
  CLI::App* filter_app = app.add_subcommand(
      "filter", "Write the robot's depth, its link IDs and the obstacles as images");
  CLI::App* evaluate_app =
      app.add_subcommand("evaluate", "Distances from these three images alone");
  CLI::App* bench_app =
      app.add_subcommand("bench", "Measure berth beside what else a user could take");
  CLI::App* study_app =
      app.add_subcommand("study", "Make the experiments of the thesis again: figures and a page");
  berth::add_demo_options(*demo_app, demo);
  berth::add_run_options(*run_app, run);
  berth::add_filter_options(*filter_app, filter);
  berth::add_evaluate_options(*evaluate_app, evaluate);
  berth::add_bench_options(*bench_app, bench);
  berth::add_study_options(*study_app, study);
  app.footer(
      "Examples:\n  berth demo\n  berth run scene.yaml --picture pictures\nberth COMMAND --help "
      "tells more.");

  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A command");
  } catch (const CLI::ParseError& error) {
    const bool asked_for_text = error.get_exit_code() == kDone;
    app.exit(error);
    return asked_for_text ? kDone : kWrongUsage;
  }
  if (*demo_app) return carry_out(demo.threads, [&] { berth::demo_command(demo); });
  if (*run_app) return carry_out(run.threads, [&] { berth::run_command(run); });
  if (*filter_app) return carry_out(filter.threads, [&] { berth::filter_command(filter); });
  if (*bench_app) return carry_out(0, [&] { berth::bench_command(bench); });
  if (*study_app) return carry_out(study.threads, [&] { berth::study_command(study); });
  return carry_out(evaluate.threads, [&] { berth::evaluate_command(evaluate); });
}
