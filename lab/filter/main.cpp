// measure_filter: what each of many settings of the self filter leaves and takes, on real
// recordings, drawn scenes and robots drawn into real images.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/filter/count_ranges.hpp"
#include "lab/filter/filter_grid.hpp"
#include "lab/filter/truth_rows.hpp"
#include "lab/trust/trial_robots.hpp"

namespace {

void print_recordings(const berth::lab::FilterGrid& grid, const std::filesystem::path& folder,
                      int draws) {
  for (const char* name : {"xarm7_realsense", "lbr_med7_zed2i"}) {
    const auto recording = berth::lab::load_recording(folder / name, draws);
    fmt::print("\n## {}, {} draws, {} images\n{}{}|\n", name, draws, recording.views.size(),
               grid.heading(), berth::lab::kCountHeading);
    for (const auto& choice : grid.choices()) {
      fmt::print("{}{}|\n", choice.cells, cells_of(count_ranges(recording, choice)));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures settings of the self filter, each value of each with all others");
  std::filesystem::path data;
  int draws = 0, drawn_scenes = 0, real_tries = 0;
  bool has_recordings = false;
  berth::lab::FilterGrid grid;
  app.add_option("--data", data, "Folder with robots, recordings and depth images")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_flag("--recordings", has_recordings, "Count the recordings' rows in range");
  app.add_option("--draws", draws, "Recordings: wrong calibrations; 0: as it is")
      ->check(CLI::Range(0, 1000));
  app.add_option("--drawn-scenes", drawn_scenes, "Measure on this number")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--real-tries", real_tries, "Draw robots into real images so often")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--tolerance_m", grid.tolerance_m, "Values, with a comma between")->delimiter(',');
  app.add_option("--padding_m", grid.padding_m)->delimiter(',');
  app.add_option("--padding_depth_m", grid.padding_depth_m)->delimiter(',');
  app.add_option("--surface_tolerance_m", grid.surface_tolerance_m)->delimiter(',');
  app.add_option("--flying_patch_radius_m", grid.flying_patch_radius_m)->delimiter(',');
  app.add_option("--speckle_px", grid.speckle_px)->delimiter(',');
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("measure_filter", 0, [&] {
    if (has_recordings) print_recordings(grid, data / "recordings", draws);
    if (drawn_scenes == 0 && real_tries == 0) return;
    const auto robots = berth::lab::load_trial_robots(data / "robots");
    if (drawn_scenes > 0) berth::lab::print_drawn_truth(grid, robots, drawn_scenes);
    if (real_tries > 0) berth::lab::print_real_images(grid, robots, data / "depth", real_tries);
  });
}
