// berth_closed_loop: an arm beside people who reach in, its speed scaled by berth.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/support/command_options.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/program.hpp"
#include "berth/files/file_bytes.hpp"
#include "lab/closed_loop/cell.hpp"
#include "lab/closed_loop/film.hpp"
#include "lab/closed_loop/hand_speeds.hpp"
#include "lab/closed_loop/table.hpp"
#include "sim/motions.hpp"

namespace berth::lab {
namespace {

struct Options {
  int encounters = 200;
  int first = 0;
  std::vector<std::string> policies;
  std::string people = "reaching";
  SimulationSettings simulation;
  std::filesystem::path csv;
  std::filesystem::path film;
  bool is_cost = false;
  std::filesystem::path motions;
  bool is_speeds = false;
};

std::vector<Policy> chosen_policies(const Options& options) {
  if (options.policies.empty()) return all_policies();
  std::vector<Policy> chosen;
  for (const std::string& name : options.policies) {
    chosen.push_back(*std::ranges::find(all_policies(), name, &Policy::name));
  }
  return chosen;
}

std::vector<EncounterResult> run_encounters(const Policy& policy, const Options& options) {
  std::vector<EncounterResult> results(options.encounters);
  tbb::parallel_for(0, options.encounters, [&](int i) {
    app::stop_if_interrupted();
    // Else a waiting thread would begin another encounter on top of this one.
    tbb::this_task_arena::isolate([&] {
      const auto supervisor = make_supervisor(policy.name, options.simulation.request_hz);
      results[i] =
          simulate(static_cast<std::uint32_t>(options.first + i), *supervisor, options.simulation);
    });
  });
  fmt::print(stderr, "{}: done\n", policy.name);
  return results;
}

void print_times(const char* of, std::vector<double> us) {
  std::ranges::sort(us);
  fmt::print("{} {}: {:.1f} us (median), {:.1f} (99 %), {:.1f} (99.9 %), {:.1f} (most)\n",
             us.size(), of, us[us.size() / 2], us[us.size() * 99 / 100], us[us.size() * 999 / 1000],
             us.back());
}

/// What a request with its monitor takes in real time, with three cameras.
void print_cost(int encounter, const SimulationSettings& simulation) {
  constexpr double kDeadline_us = 300;
  MonitorSupervisor supervisor({0, 1, 2}, cell_separation(simulation.request_hz),
                               ShownBy::along_path, kDeadline_us);
  simulate(static_cast<std::uint32_t>(encounter), supervisor, simulation);
  print_times("requests and their monitor", supervisor.request_us());
  print_times("times the monitor alone", supervisor.monitor_us());
}

void run(Options options) {
  const bool is_bvh = options.simulation.kind == sim::VisitKind::bvh;
  if (is_bvh || options.is_speeds) {
    if (options.motions.empty()) {
      throw std::invalid_argument("--motions: not given; expected a folder with *.bvh files");
    }
    options.simulation.motions =
        std::make_shared<const std::vector<sim::Bvh>>(sim::read_motions(options.motions));
  }
  if (options.is_speeds) return fmt::print("{}", hand_speed_table(*options.simulation.motions));
  if (options.is_cost) return print_cost(options.first, options.simulation);
  if (!options.film.empty()) {
    const bool has_goals = options.policies == std::vector<std::string>{"filter"};
    return film_encounter(static_cast<std::uint32_t>(options.first), has_goals, options.film);
  }
  const std::vector<Policy> policies = chosen_policies(options);
  std::vector<std::vector<EncounterResult>> results;
  for (const Policy& policy : policies) results.push_back(run_encounters(policy, options));
  if (!options.csv.empty()) write_file_bytes(options.csv, encounter_csv(policies, results));
  fmt::print("{}\n{}", encounter_table(policies, results), census_table(policies, results));
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  using namespace berth;
  CLI::App program(
      "An arm goes round its pick-and-place cycle while people reach in from drawn directions. "
      "Prints how near they came, by who supervised the arm's speed.");
  lab::Options options;
  std::vector<std::string> names;
  std::string list;
  for (const lab::Policy& policy : lab::all_policies()) {
    names.push_back(policy.name);
    list += "\n  " + policy.name + ": " + policy.sentence;
  }
  program.footer("Policies:" + list);
  program.add_option("--encounters", options.encounters, "how many, for each policy")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  program.add_option("--first", options.first, "the number of the first one")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  program.add_option("--policy", options.policies, "only these")->check(CLI::IsMember(names));
  program.add_option("--people", options.people, "who comes")
      ->check(CLI::IsMember(
          std::vector<std::string>(sim::kVisitKindNames.begin(), sim::kVisitKindNames.end())))
      ->capture_default_str();
  program
      .add_option("--presence", options.simulation.presence,
                  "the share of the time in which somebody is there; 0: nobody ever")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  program.add_option("--rate", options.simulation.request_hz, "questions a second")
      ->check(CLI::Range(10.0, 1000.0))
      ->capture_default_str();
  program
      .add_option("--image-age", options.simulation.image_latency_s,
                  "seconds from an exposure until its image comes")
      ->check(CLI::Range(0.0, 0.5))
      ->capture_default_str();
  program.add_option("--motions", options.motions,
                     "a folder with the *.bvh files that --people bvh moves by");
  program.add_flag("--speeds", options.is_speeds,
                   "only how fast the hands are in the motions of --motions");
  program.add_option("--csv", options.csv, "a file for each encounter's figures");
  program.add_flag("--cost", options.is_cost,
                   "only what requests and monitor cost, in encounter --first");
  program
      .add_option("--film", options.film,
                  "only pictures and figures of encounter --first, into this folder: of --policy "
                  "filter, else path")
      ->check(CLI::ExistingDirectory);
  if (const auto status = app::parse_command_line(program, argc, argv)) return *status;
  options.simulation.kind = static_cast<sim::VisitKind>(
      std::ranges::find(sim::kVisitKindNames, options.people) - sim::kVisitKindNames.begin());
  options.simulation.most_s = std::numeric_limits<double>::infinity();
  app::note_interrupts();
  return app::carry_out("berth_closed_loop", 0, [&] { lab::run(options); });
}
