// measure_calibration: how near calibration comes to the truth, on real recordings and drawn ones.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <numbers>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/calibration/attached_table.hpp"
#include "lab/calibration/drawn.hpp"
#include "lab/calibration/recordings.hpp"
#include "sim/drawn_hand_camera.hpp"

int main(int argc, char** argv) {
  namespace lab = berth::lab;
  CLI::App app(
      "Measures calibration: recordings from random starts, drawn scenes with known truth");
  std::filesystem::path data;
  std::string robot;
  int starts = 0;
  double zero_deg = 0;
  int attached_seeds = 0;
  int company_seeds = 0;
  bool is_on_hand = false;
  bool is_on_upper_link = false;
  lab::DrawnTrials trials;
  trials.seeds = 0;
  app.add_option("--data", data, "Folder with robots and recordings")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--starts", starts, "Recordings: the number of random starts");
  app.add_option("--judged", trials.start.judged, "How many of them are judged by known distances");
  app.add_option("--offset-m", trials.start.offset_m, "How far off a start is");
  app.add_option("--angle-deg", trials.start.angle_deg);
  app.add_option("--seeds", trials.seeds, "Drawn scenes: how many of each robot");
  app.add_option("--robot", robot, "Only robots whose names hold this");
  app.add_option("--poses", trials.drawn.poses);
  app.add_flag("--moves", trials.drawn.moves, "Images are taken while the robot moves");
  app.add_flag("--hand", is_on_hand, "The camera is fixed to the last link that a joint turns");
  app.add_flag("--upper-link", is_on_upper_link,
               "The camera is fixed to a link half the way up the arm");
  app.add_option("--depth-share", trials.drawn.errors.depth_share);
  app.add_option("--clock-s", trials.drawn.errors.clock_offset_s);
  app.add_option("--joint-zero-deg", zero_deg);
  app.add_option("--attached", attached_seeds,
                 "Cells with what robots carry: how many of each robot, kind, poses and cameras");
  app.add_option("--company", company_seeds,
                 "The same of robots that carry nothing, with others in their images");
  app.add_flag("--each", trials.prints_each, "Tell each drawn scene on standard error");
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("measure_calibration", 0, [&] {
    if (starts > 0) {
      const std::filesystem::directory_iterator folders(data / "recordings");
      std::vector<std::filesystem::path> recordings(begin(folders), end(folders));
      std::ranges::sort(recordings);
      for (const auto& folder : recordings) lab::measure_recording(folder, trials.start, starts);
    }
    if (attached_seeds > 0) {
      lab::measure_attached(lab::load_trial_robots(data / "robots"), robot, attached_seeds,
                            trials.prints_each);
    }
    if (company_seeds > 0) {
      lab::measure_company(lab::load_trial_robots(data / "robots"), robot, company_seeds);
    }
    if (trials.seeds == 0) return;
    trials.drawn.errors.joint_zero = zero_deg * std::numbers::pi / 180;
    trials.joint_zeros = zero_deg > 0;
    if (is_on_hand) trials.drawn.mount = berth::sim::DrawnMount::hand;
    if (is_on_upper_link) trials.drawn.mount = berth::sim::DrawnMount::upper_link;
    std::vector<lab::TrialRobot> robots = lab::load_trial_robots(data / "robots");
    std::erase_if(robots, [&](const lab::TrialRobot& one) {
      return one.name.find(robot) == std::string::npos;
    });
    fmt::print(
        "{}| start {:.0f} cm, {:.0f} degrees off, depth {:g} %, clock {:g} ms, joints {:g} "
        "degrees, {} poses | {} ",
        lab::kDrawnHeading, 100 * trials.start.offset_m, trials.start.angle_deg,
        100 * trials.drawn.errors.depth_share, 1000 * trials.drawn.errors.clock_offset_s, zero_deg,
        trials.drawn.poses, robots.size() * trials.seeds);
    lab::measure_drawn(robots, trials);
  });
}
