// measure_bumped: which limits of T and which k of n frames find bumped cameras, and raise no alarm
// for people.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "lab/watch/bumped.hpp"

namespace berth::lab {
namespace {

struct Measured {
  std::string name;
  SeenThroughs own;
  std::vector<SeenThroughs> by_2_cm, by_5_cm, by_2_deg, hidden;
};

Measured measure(const OpenCamera& camera, int nth, int draws) {
  return {camera.source.name,
          own_frames(camera),
          bumped_seconds(camera, {.offset_m = 0.02}, nth),
          bumped_seconds(camera, {.offset_m = 0.05}, nth),
          bumped_seconds(camera, {.angle_rad = 2 * std::numbers::pi / 180}, nth),
          hidden_seconds(camera, draws)};
}

/// The greatest one that is told; -1 where none is.
double greatest(const SeenThroughs& frames) {
  double most = -1;
  for (const double told : frames) most = std::fmax(most, told);
  return most;
}

void print_row(const Measured& camera, const WatchSettings& rule) {
  fmt::print("| {} | {:.1f} % | {} of {} | {:.0f} % | {:.0f} % | {:.0f} % | {} | {:.0f} of {} |\n",
             camera.name, 100 * rule.max_seen_through, rule.agreeing_frames, rule.frames,
             100 * alarm_share(camera.by_2_cm, rule), 100 * alarm_share(camera.by_5_cm, rule),
             100 * alarm_share(camera.by_2_deg, rule),
             is_alarm(camera.own, rule) ? "alarm" : "none",
             alarm_share(camera.hidden, rule) * static_cast<double>(camera.hidden.size()),
             camera.hidden.size());
}

void print_camera(const Measured& camera) {
  double hidden = -1;
  for (const SeenThroughs& second : camera.hidden) hidden = std::max(hidden, greatest(second));
  const WatchSettings learned = learned_limits(camera.own, {});
  fmt::print(
      "\n{}: greatest T {:.2f} % of its own frames, {:.2f} % with people; learned limit {:.2f} "
      "%\n\n",
      camera.name, 100 * greatest(camera.own), 100 * hidden, 100 * learned.max_seen_through);
  fmt::print(
      "| camera | limit | frames | 2 cm | 5 cm | 2 deg | own frames | people |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  WatchSettings rule = learned;
  for (const double limit : {0.01, 0.015, 0.02, 0.025, 0.03, 0.035, 0.04, 0.06}) {
    rule.max_seen_through = limit;
    print_row(camera, rule);
  }
  for (const auto& [agreeing, frames] : {std::pair{1, 1},
                                         {2, 3},
                                         {5, 5},
                                         {6, 9},
                                         {8, 10},
                                         {8, 15},
                                         {10, 15},
                                         {14, 15},
                                         {20, 30},
                                         {30, 30}}) {
    rule = learned;
    rule.agreeing_frames = agreeing;
    rule.frames = frames;
    print_row(camera, rule);
  }
}

void print_whole_watch(const OpenCamera& camera, int nth, int draws) {
  const WatchSettings rule = learned_limits(own_frames(camera), own_displacements(camera, nth));
  const auto cell = [](const AlarmCount& count) {
    return fmt::format("{} of {}", count.alarms, count.seconds);
  };
  constexpr double kDegree = std::numbers::pi / 180;
  fmt::print("| {} | {:.1f} % | {:.0f} mm | {} | {} | {} | {} | {} |\n", camera.source.name,
             100 * rule.max_seen_through, 1000 * rule.max_displacement_m,
             cell(bumped_alarms(camera, {.offset_m = 0.02}, nth, rule)),
             cell(bumped_alarms(camera, {.angle_rad = 2 * kDegree}, nth, rule)),
             cell(bumped_alarms(camera, {.angle_rad = 1 * kDegree}, nth, rule)),
             cell(bumped_alarms(camera, {}, nth, rule)), cell(hidden_alarms(camera, draws, rule)));
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  CLI::App app{"How often T alone finds a bumped camera within a second, and alarms for nothing"};
  std::string scene_file;
  int nth = 1, draws = 50;
  bool whole_watch = false;
  app.add_option("scene", scene_file, "the scene file")->required();
  app.add_option("--nth", nth, "every Nth frame is bumped")->check(CLI::Range(1, 1000));
  app.add_option("--draws", draws, "people for each camera")->check(CLI::Range(1, 1000));
  app.add_flag("--whole-watch", whole_watch, "T and D together, by the limits that are learned");
  CLI11_PARSE(app, argc, argv);
  const OpenScene scene = open_scene(scene_file);
  if (whole_watch) {
    fmt::print(
        "| camera | T | D | 2 cm | 2 degrees | 1 degree | not bumped | people |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const OpenCamera& camera : scene.cameras) print_whole_watch(camera, nth, draws);
    return 0;
  }
  for (const OpenCamera& camera : scene.cameras) print_camera(measure(camera, nth, draws));
  return 0;
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) { return berth::lab::run(argc, argv); }
