// measure_sequences: what berth reports on an arm and people that move, beside the truth.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/closed_loop/sequence.hpp"

namespace berth::lab {
namespace {

void measure(int first, int encounters) {
  const std::vector<SequenceCondition> conditions = sequence_conditions();
  std::vector<std::vector<std::vector<SequenceInstant>>> runs(static_cast<std::size_t>(encounters));
  tbb::parallel_for(0, encounters, [&](int i) {
    // Else a waiting thread would begin another encounter on top of this one.
    tbb::this_task_arena::isolate([&] {
      runs[static_cast<std::size_t>(i)] =
          run_sequence(static_cast<std::uint32_t>(first + i), conditions);
    });
  });
  std::vector<std::vector<SequenceInstant>> all(conditions.size());
  for (const auto& run : runs) {
    for (std::size_t c = 0; c < all.size(); ++c) {
      all[c].insert(all[c].end(), run[c].begin(), run[c].end());
    }
  }
  fmt::print("{}", sequence_table(conditions, all));
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App program(
      "An arm goes round its pick-and-place cycle while people reach in, among things that are in "
      "no model. Prints how often, and by how much, berth's distances are not the true ones.");
  int first = 0, encounters = 11;
  program.add_option("--encounters", encounters, "how many")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  program.add_option("--first", first, "the number of the first one")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  if (const auto status = berth::app::parse_command_line(program, argc, argv)) return *status;
  return berth::app::carry_out("measure_sequences", 0,
                               [&] { berth::lab::measure(first, encounters); });
}
