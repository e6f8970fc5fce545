// measure_bumped: whether T and D, by the limits that are learned, find a bumped camera within a
// second, and raise no alarm for people.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <numbers>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/watch/bumped.hpp"

namespace berth::lab {
namespace {

void print_camera(const OpenCamera& camera, int nth, int draws) {
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

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App app{"How often T and D find a bumped camera within a second, and alarm for nothing"};
  std::string scene_file;
  int nth = 1, draws = 50;
  app.add_option("scene", scene_file, "the scene file")->required();
  app.add_option("--nth", nth, "every Nth frame is bumped")->check(CLI::Range(1, 1000));
  app.add_option("--draws", draws, "people for each camera")->check(CLI::Range(1, 1000));
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("measure_bumped", 0, [&] {
    fmt::print(
        "| camera | T | D | 2 cm | 2 degrees | 1 degree | not bumped | people |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    const berth::OpenScene scene = berth::open_scene(scene_file);
    for (const berth::OpenCamera& camera : scene.cameras) {
      berth::lab::print_camera(camera, nth, draws);
    }
  });
}
