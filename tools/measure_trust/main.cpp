// measure_trust: how far berth's distances are from the true ones, on random scenes.
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <array>
#include <atomic>
#include <exception>
#include <filesystem>

#include "tables.hpp"
#include "trial_robots.hpp"

namespace berth {
namespace {

/// One of a scene's seeds in turn.
constexpr std::array<std::pair<int, int>, 3> kSizes_px = {{{320, 240}, {640, 480}, {960, 540}}};

std::vector<Trial> run_trials(const std::vector<TrialRobot>& robots,
                              const std::vector<Condition>& conditions, int scenes) {
  std::vector<Trial> trials(scenes);
  std::atomic<int> done = 0;
  tbb::parallel_for(0, scenes, [&](int i) {
    const auto [width_px, height_px] = kSizes_px[i % kSizes_px.size()];
    // Else a waiting thread would begin another scene on top of this one.
    tbb::this_task_arena::isolate([&] {
      trials[i] = run_trial(robots[i / kSizes_px.size() % robots.size()],
                            {.width_px = width_px, .height_px = height_px},
                            static_cast<std::uint32_t>(i), conditions);
    });
    if (++done % 50 == 0) fmt::print(stderr, "{} of {} scenes\n", done.load(), scenes);
  });
  return trials;
}

void measure_trust(int scenes, const std::filesystem::path& robots_folder) {
  const std::vector<TrialRobot> robots = load_trial_robots(robots_folder);
  const std::vector<Condition> conditions = all_conditions();
  const std::vector<Trial> trials = run_trials(robots, conditions, scenes);
  fmt::print("{} scenes, {} robots\n", scenes, robots.size());
  fmt::print("{}", condition_tables(trials, conditions));
  const std::array titles = {
      std::pair("The distance alone, clean image", std::size_t{0}),
      std::pair("The nearest point of the hidden ray", std::size_t{1}),
      std::pair("The whole pipeline, clean image", first_of_pipeline(conditions))};
  for (const auto& [title, condition] : titles) {
    fmt::print("\n## {}: where the obstacle's nearest point is\n{}", title,
               sight_table(trials, condition));
    fmt::print("\n## {}: by robot and image\n{}", title, bound_table(trials, condition));
    fmt::print("\n## {}: the worst\n{}", title, worst_table(trials, condition, 8));
  }
}

}  // namespace
}  // namespace berth

int main(int argc, char** argv) {
  CLI::App app("Compares berth's distances with the true ones, mesh to mesh, on random scenes");
  int scenes = 1000;
  std::filesystem::path robots;
  app.add_option("--scenes", scenes, "How many; their seeds count from 0")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--robots", robots, "Folder of robots, besides the bundled one")
      ->check(CLI::ExistingDirectory);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    berth::measure_trust(scenes, robots);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "measure_trust: {}\n", error.what());
    return 1;
  }
}
