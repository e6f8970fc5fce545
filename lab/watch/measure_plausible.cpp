// measure_plausible: which simple mistakes in a scene are found and named right, and how often
// there is an alarm for nothing.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <numbers>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/robot_in_images.hpp"
#include "lab/trust/trial_robots.hpp"
#include "lab/watch/good_scenes.hpp"
#include "lab/watch/mistakes.hpp"

namespace berth::lab {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

struct Count {
  int tried = 0;
  int found = 0;
  int named = 0;
  int named_wrong = 0;
  /// Of single images that tell: the share of the robot's readings at its surface.
  double least_at_robot = 1;
  double most_at_robot = 0;
};

bool is_named(const CameraPlausibility& found, const std::string& cause) {
  return !cause.empty() && (found.cause.find(cause) != std::string::npos ||
                            found.dead.find(cause) != std::string::npos);
}

void look(const OpenScene& scene, std::size_t camera, const std::string& cause, bool says,
          Count& count) {
  const CameraPlausibility found = find_implausible(scene, camera);
  ++count.tried;
  count.found += found.is_implausible;
  count.named += is_named(found, cause);
  count.named_wrong += !(found.cause + found.dead).empty() && !is_named(found, cause);
  if (says && (found.is_implausible || !cause.empty())) {
    fmt::print(stderr, "  {}\n", text_of(found));
  }
  RobotInImages images(scene, camera);
  for (std::size_t i = 0; i < images.frames().size(); ++i) {
    const RobotReadings readings = images.readings(images.given(), i);
    if (!readings.tells()) continue;
    count.least_at_robot = std::min(count.least_at_robot, readings.at_robot());
    count.most_at_robot = std::max(count.most_at_robot, readings.at_robot());
  }
}

void print_row(const std::string& name, const Count& count) {
  const bool is_told = count.least_at_robot <= count.most_at_robot;
  fmt::print("| {} | {} of {} | {} | {} | {} |\n", name, count.found, count.tried, count.named,
             count.named_wrong,
             is_told ? fmt::format("{:.1f} to {:.1f} %", 100 * count.least_at_robot,
                                   100 * count.most_at_robot)
                     : "–");
  std::fflush(stdout);
}

template <class Change>
void print_good(const OpenScene& scene, const std::string& name, int draws, bool says,
                const Change& change) {
  Count count;
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    for (int draw = 0; draw < draws; ++draw) {
      OpenScene drawn = scene;
      change(drawn, c, static_cast<std::uint32_t>(draw));
      look(drawn, c, "", says, count);
    }
  }
  print_row(name, count);
}

void print_scene(const OpenScene& scene, int draws, bool says) {
  fmt::print(
      "\n{}\n\n| | found | named right | named wrong | at the surface, single images |\n"
      "| --- | ---: | ---: | ---: | ---: |\n",
      scene.file.parent_path().filename().string());
  for (const MadeMistake& mistake : mistakes_in(scene)) {
    Count count;
    if (says) fmt::print(stderr, "{}\n", mistake.name);
    for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
      OpenScene wrong = scene;
      mistake.make(wrong, c);
      look(wrong, c, mistake.cause, says, count);
    }
    print_row(mistake.name, count);
  }
  print_good(scene, "no mistake", 1, says, [](OpenScene&, std::size_t, std::uint32_t) {});
  for (const auto& [cm, degrees] : {std::array{2, 2}, {5, 5}, {20, 15}}) {
    print_good(scene, fmt::format("pose {} cm and {} degrees off", cm, degrees), draws, says,
               [&](OpenScene& drawn, std::size_t c, std::uint32_t seed) {
                 move_camera(drawn, c, cm / 100.0, degrees * kDegree_rad, seed);
               });
  }
  print_good(scene, "people who hide up to 90 %", draws, says, hide_robot);
}

/// Of the robots in turn.
void print_drawn(const std::filesystem::path& robots_folder, int scenes) {
  const std::vector<TrialRobot> robots = load_trial_robots(robots_folder);
  int drawn = 0, implausible = 0, doubted = 0;
  for (int i = 0; i < scenes; ++i) {
    const RobotModel& model = robots[i % robots.size()].model;
    const auto seed = static_cast<std::uint32_t>(40000 + i);
    try {
      const OpenScene scene = draw_good_scene(model, seed);
      const CameraPlausibility found = find_implausible(scene, 0);
      ++drawn;
      implausible += found.is_implausible;
      doubted += !found.is_implausible && !doubt_of(found).empty();
      if (!text_of(found).empty())
        fmt::print("{}, seed {}: {}\n", model.name, seed, text_of(found));
    } catch (const std::runtime_error& error) {
      fmt::print(stderr, "seed {}: {}\n", seed, error.what());
    }
  }
  fmt::print("{} drawn scenes without a mistake: {} implausible, {} doubted\n", drawn, implausible,
             doubted);
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App app{
      "Which simple mistakes in a scene are found and named, and what is found for nothing"};
  std::vector<std::string> files;
  int draws = 50;
  bool says = false;
  app.add_option("scenes", files, "scene files without a mistake");
  app.add_option("--draws", draws, "poses and people for each camera")->check(CLI::Range(1, 1000));
  int drawn = 0;
  std::string robots_folder;
  app.add_option("--drawn", drawn, "how many drawn scenes without a mistake as well");
  app.add_option("--robots", robots_folder, "more robots for them, a folder each");
  app.add_flag("--say", says, "print what is said of each mistake to standard error");
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("measure_plausible", 0, [&] {
    for (const std::string& file : files) {
      berth::lab::print_scene(berth::open_scene(file), draws, says);
    }
    if (drawn > 0) berth::lab::print_drawn(robots_folder, drawn);
  });
}
