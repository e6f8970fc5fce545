// berth_bench: measures berth beside what else a user could take.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <tuple>
#include <utility>

#include "apps/support/command_options.hpp"
#include "apps/support/data_folders.hpp"
#include "apps/support/program.hpp"
#include "lab/bench/bench.hpp"
#include "lab/stream/configurations.hpp"

namespace {

using berth::BackendChoice;
using berth::lab::BenchSettings;
using berth::lab::ConfigurationSettings;
using berth::lab::StreamSettings;

void add_options(CLI::App& program, BenchSettings& settings, BackendChoice& where) {
  program.add_flag("--quick", settings.quick, "A thinned run of less than half a minute");
  program
      .add_option("--random-scenes", settings.random_scenes,
                  "Number of random scenes where the run is not thinned (default: 200)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  program
      .add_option("--whole-robot-scenes", settings.whole_robot_scenes,
                  "The same for the method mesh with several cameras (default: 100)")
      ->check(CLI::Range(1, 100000))
      ->type_name("N");
  program.add_flag("--whole-robot", settings.whole_robot_alone,
                   "Only the method mesh with several cameras");
  program
      .add_option("--out", settings.out_folder,
                  "Folder for results.md and whole_robot.md; made if it is not there")
      ->type_name("DIR");
  program
      .add_option("--scene", settings.scenes,
                  "A recording to measure as well; may stand several times")
      ->type_name("SCENE.yaml");
  berth::app::add_backend_options(
      program, "Which methods to measure: those of the processor, or those on OpenGL", where);
  program.footer("Example:\n  berth_bench --quick --out bench_results --scene scene.yaml");
}

/// What is filmed, of both --stream and --configurations.
void add_film_options(CLI::App& program, StreamSettings& stream, bool& asks_configurations) {
  CLI::Option* const scene =
      program
          .add_option(
              "--stream", stream.scene,
              "Nothing but this: play the scene forth and back in real time, and ask meanwhile")
          ->type_name("SCENE.yaml");
  program
      .add_option_function<std::filesystem::path>(
          "--configurations",
          [&](const std::filesystem::path& file) {
            stream.scene = file;
            asks_configurations = true;
          },
          "Nothing but this: ask about many configurations of images of the scene")
      ->type_name("SCENE.yaml")
      ->excludes(scene);
  program.add_option("--cameras", stream.cameras, "How many of the scene's cameras (default: all)")
      ->check(CLI::Range(1, 8))
      ->type_name("N");
  program
      .add_option_function<std::string>(
          "--format", [&stream](const std::string& format) { stream.as_json = format == "json"; },
          "What these two print: text, or one JSON object (default: text)")
      ->check(CLI::IsMember({"text", "json"}));
  program.final_callback([&stream] {
    if (!stream.scene.empty() || (!stream.room && !stream.as_json && stream.cameras == 0)) return;
    throw CLI::RequiresError("--room, --cameras and --format", "--stream or --configurations");
  });
}

void add_configuration_options(CLI::App& program, ConfigurationSettings& configurations) {
  CLI::Option* const scene = program.get_option("--configurations");
  program.add_option("--count", configurations.count, "How many configurations (default: 100000)")
      ->check(CLI::Range(1, 100'000'000))
      ->type_name("N")
      ->needs(scene);
  program.add_option("--margin", configurations.margin_m, "What is near, in m (default: 0.03)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("M")
      ->needs(scene);
}

void add_stream_options(CLI::App& program, StreamSettings& stream) {
  CLI::Option* const scene = program.get_option("--stream");
  program.add_option("--rate", stream.rate_hz, "Requests a second of the stream (default: 1000)")
      ->check(CLI::Range(1.0, 100000.0))
      ->type_name("HZ")
      ->needs(scene);
  program.add_option("--seconds", stream.seconds, "How long the stream is asked (default: 10)")
      ->check(CLI::Range(0.1, 3600.0))
      ->type_name("S")
      ->needs(scene);
  program
      .add_option("--speed", stream.speed,
                  "How many times as fast as recorded the stream is played (default: 3)")
      ->check(CLI::Range(0.01, 100.0))
      ->type_name("X")
      ->needs(scene);
  program
      .add_option("--plans", stream.plans_hz,
                  "How often a second a planner makes a field meanwhile (default: never)")
      ->check(CLI::Range(0.1, 100.0))
      ->type_name("HZ")
      ->needs(scene);
  program
      .add_option("--record", stream.record,
                  "Record the stream as a black box does, and write a recording of its end here")
      ->type_name("FILE.mcap")
      ->needs(scene);
  program
      .add_flag("--steps", stream.in_steps,
                "Not in real time: the processor time of each of the stream's steps")
      ->needs(scene);
}

void add_room_options(CLI::App& program, StreamSettings& stream) {
  CLI::Option* const room =
      program
          .add_option_function<std::uint32_t>(
              "--room", [&stream](std::uint32_t seed) { stream.room = {.seed = seed}; },
              "The scene's robot sways in a room drawn by this seed, instead of what was filmed")
          ->type_name("SEED");
  program
      .add_option_function<std::pair<int, int>>(
          "--image",
          [&stream](const std::pair<int, int>& size) {
            std::tie(stream.room->width_px, stream.room->height_px) = size;
          },
          "How many pixels the room's cameras have (default: 640 480)")
      ->check(CLI::Range(16, 4096))
      ->type_name("WIDTH HEIGHT")
      ->needs(room);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Measures berth beside what else a user could take");
  BenchSettings settings;
  BackendChoice where;
  StreamSettings stream;
  ConfigurationSettings configurations;
  bool asks_configurations = false;
  add_options(program, settings, where);
  add_film_options(program, stream, asks_configurations);
  add_configuration_options(program, configurations);
  add_stream_options(program, stream);
  add_room_options(program, stream);
  if (const auto status = berth::app::parse_command_line(program, argc, argv)) return *status;
  return berth::app::carry_out("berth_bench", 0, [&] {
    if (asks_configurations) {
      return fmt::print("{}", berth::lab::run_configurations(stream, configurations));
    }
    if (!stream.scene.empty()) return fmt::print("{}", berth::lab::run_stream(stream));
    settings.bundled_scene = berth::app::bundled_one_camera_file();
    if (where.backend == berth::Backend::opengl) settings.gl_device = where.gl_device;
    berth::lab::run_benchmarks(settings);
  });
}
