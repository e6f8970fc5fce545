// berth_trust: how far berth's distances are from the true ones, on random scenes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <optional>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/measure/each_alone.hpp"
#include "lab/trust/contact_trial.hpp"
#include "lab/trust/look.hpp"
#include "lab/trust/real_image.hpp"
#include "lab/trust/tables.hpp"
#include "lab/trust/trial_robots.hpp"
#include "lab/trust/whole_robot_tables.hpp"

namespace berth::lab {
namespace {

void measure_trust(const std::vector<TrialRobot>& robots, int scenes) {
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

/// Which scenes with several cameras are drawn, and what is wrong with their images.
struct WholeRobotOptions {
  int first = 0;
  bool is_full_size = false;
  std::vector<std::string> conditions;
  SpaceSettings space;
  double phantom_radius_m = SensorSettings{}.phantom_radius_m;
};

std::vector<WholeRobotCondition> chosen_conditions(const WholeRobotOptions& options) {
  const std::vector<std::string>& parts = options.conditions;
  std::vector<WholeRobotCondition> conditions = whole_robot_conditions();
  for (WholeRobotCondition& condition : conditions) {
    condition.space = options.space;
    condition.phantom_radius_m = options.phantom_radius_m;
  }
  if (parts.empty()) return conditions;
  std::erase_if(conditions, [&](const WholeRobotCondition& condition) {
    return std::ranges::none_of(parts, [&](const std::string& part) {
      return condition.name.find(part) != std::string::npos;
    });
  });
  return conditions;
}

/// Scenes with several cameras, against the distances of whole links.
void measure_whole_robot(const std::vector<TrialRobot>& robots, int scenes,
                         const WholeRobotOptions& options) {
  const auto conditions = chosen_conditions(options);
  std::vector<WholeRobotTrial> trials(scenes);
  std::atomic<int> done = 0;
  each_alone(scenes, [&](int i) {
    const int seed = options.first + i;
    const auto settings =
        options.is_full_size ? sim::DrawnSceneSettings{.sizes_differ = false} : trial_scene(seed);
    trials[i] = run_whole_robot_trial(trial_robot(robots, seed), settings,
                                      static_cast<std::uint32_t>(seed), conditions);
    if (++done % 10 == 0) fmt::print(stderr, "{} of {} scenes\n", done.load(), scenes);
  });
  fmt::print("{} scenes, {} robots\n{}\n{}", scenes, robots.size(),
             monitor_table(trials, conditions), whole_robot_table(trials, conditions));
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    fmt::print("\n### {}: by where the obstacle's nearest point is\n{}", conditions[c].name,
               whole_robot_sight_table(trials, c));
    fmt::print("\n### {}: the worst\n{}", conditions[c].name,
               worst_whole_robot_table(trials, c, 3));
  }
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App program("Compares berth's distances with the true ones, mesh to mesh, on random scenes");
  int scenes = 1000;
  std::filesystem::path robots_folder;
  std::filesystem::path real_images;
  std::optional<int> look;
  bool whole_robot = false;
  bool contact = false;
  bool unobserved = false;
  berth::lab::WholeRobotOptions whole_robot_options;
  std::filesystem::path picture = "scene.png";
  program.add_option("--scenes", scenes, "How many; their seeds count from 0")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  program.add_option("--robots", robots_folder, "Folder of robots, besides the bundled one")
      ->check(CLI::ExistingDirectory);
  program
      .add_option(
          "--real-images", real_images,
          "Instead, draw the robots into real depth images (folder depth/ of the recordings)")
      ->check(CLI::ExistingDirectory);
  program.add_flag("--whole-robot", whole_robot,
                   "Instead, the method `mesh` with one to four cameras, on whole links");
  program.add_flag("--contact", contact,
                   "Instead, things that touch the robot, give no reading or stand beside all "
                   "images; the kinds share --scenes");
  program.add_flag("--unobserved", unobserved,
                   "Instead, people beside all images of one to four cameras, by what "
                   "space.unobserved says");
  program
      .add_option("--first", whole_robot_options.first,
                  "With --whole-robot: the seed of the first scene")
      ->check(CLI::Range(0, 1000000));
  program.add_flag("--full-size", whole_robot_options.is_full_size,
                   "With --whole-robot: all cameras have 640 x 480 pixels");
  program.add_option("--condition", whole_robot_options.conditions,
                     "With --whole-robot: only the conditions whose names hold one of these");
  program
      .add_option("--detection-capability", whole_robot_options.space.detection_capability_m,
                  "With --whole-robot: of the space settings, in m")
      ->check(CLI::NonNegativeNumber);
  program
      .add_option("--phantom-radius", whole_robot_options.phantom_radius_m,
                  "With --whole-robot: of the sensor settings, in m")
      ->check(CLI::NonNegativeNumber);
  program.add_flag_callback(
      "--no-reading-free", [&] { whole_robot_options.space.no_reading = berth::NoReading::free; },
      "With --whole-robot: a pixel without a reading frees its line of sight");
  program.add_option("--look", look, "Instead, print and draw the scene of this seed")
      ->check(CLI::Range(0, 1000000));
  program.add_option("--picture", picture, "Where --look draws to")->capture_default_str();
  if (const auto status = berth::app::parse_command_line(program, argc, argv)) return *status;
  return berth::app::carry_out("berth_trust", 0, [&] {
    const auto robots = berth::lab::load_trial_robots(robots_folder);
    if (look) {
      berth::lab::look_at_scene(berth::lab::trial_robot(robots, *look),
                                berth::lab::trial_scene(*look), static_cast<std::uint32_t>(*look),
                                picture);
    } else if (whole_robot) {
      berth::lab::measure_whole_robot(robots, scenes, whole_robot_options);
    } else if (contact) {
      fmt::print("{}", berth::lab::contact_table(robots, whole_robot_options.first, scenes));
    } else if (unobserved) {
      fmt::print("{}", berth::lab::unobserved_table(robots, whole_robot_options.first, scenes));
    } else if (!real_images.empty()) {
      const auto images = berth::lab::load_real_images(real_images);
      fmt::print("{}", berth::lab::real_image_table(images, robots, scenes));
    } else {
      berth::lab::measure_trust(robots, scenes);
    }
  });
}
