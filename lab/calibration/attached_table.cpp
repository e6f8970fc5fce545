#include "lab/calibration/attached_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "berth/calibration/carried_cells.hpp"
#include "lab/calibration/attached.hpp"

namespace berth::lab {
namespace {

constexpr std::array kRobots = {"bundled arm", "xarm7/xarm7", "kuka_lbr_med7/lbr_med7",
                                "franka_panda/panda", "kuka_lwr4_bullet/kuka"};
struct Kind {
  sim::DrawnKind kind;
  const char* name;
};
constexpr std::array kKinds = {
    Kind{sim::DrawnKind::tool, "tool"}, Kind{sim::DrawnKind::bent_tool, "bent tool"},
    Kind{sim::DrawnKind::cable_box, "cable box"}, Kind{sim::DrawnKind::bare, "nothing"}};

/// Of many trials.
struct Tally {
  std::vector<double> precision, recall, time_s;
  int trials = 0, shown = 0, false_parts = 0, with_room = 0;

  void add(const AttachedTrial& trial) {
    ++trials;
    shown += trial.poses_shown >= kLeastRoomPlaces;
    false_parts += trial.false_parts;
    with_room += trial.room_points > 0;
    time_s.push_back(trial.time_s);
    if (!trial.is_found) return;
    precision.push_back(trial.precision);
    recall.push_back(trial.recall);
  }
};

/// "median, worst" in %.
std::string share_text(std::vector<double> shares) {
  if (shares.empty()) return "–";
  std::ranges::sort(shares);
  return fmt::format("{:.0f}, {:.0f} %", 100 * shares[shares.size() / 2], 100 * shares.front());
}

void print_row(const char* kind, int poses, int cameras, Tally tally) {
  std::ranges::sort(tally.time_s);
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.2f} |\n", kind, poses, cameras,
             tally.trials, tally.shown, tally.precision.size(), share_text(tally.precision),
             share_text(tally.recall), tally.false_parts, tally.with_room,
             tally.time_s[tally.time_s.size() / 2]);
  std::fflush(stdout);
}

}  // namespace

void measure_attached(const std::vector<TrialRobot>& robots, const std::string& only, int seeds,
                      bool prints_each) {
  fmt::print(
      "| carried | poses | cameras | cells | shown in three poses | found | precision at 1 cm: "
      "median, worst | recall | parts "
      "that "
      "are none | with a piece of the room | median s |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Kind& kind : kKinds) {
    for (const int poses : {5, 10}) {
      for (const int cameras : {1, 3}) {
        Tally tally;
        for (const TrialRobot& robot : robots) {
          if (std::ranges::find(kRobots, std::string_view(robot.name)) == kRobots.end()) continue;
          if (robot.name.find(only) == std::string::npos) continue;
          for (int seed = 1; seed <= seeds; ++seed) {
            const AttachedTrial trial = try_attached(robot.model, robot.meshes, kind.kind, poses,
                                                     cameras, static_cast<std::uint32_t>(seed));
            tally.add(trial);
            if (!prints_each) continue;
            fmt::print(stderr,
                       "{} {} {} poses {} cameras {}: shown in {} poses, {} parts, found {}, "
                       "precision {:.2f}, recall "
                       "{:.2f}, false {}, room {}, share {:.2f}, {:.2f} s\n",
                       robot.name, kind.name, poses, cameras, seed, trial.poses_shown, trial.parts,
                       trial.is_found, trial.precision, trial.recall, trial.false_parts,
                       trial.room_points, trial.explained_share, trial.time_s);
          }
        }
        if (tally.trials > 0) print_row(kind.name, poses, cameras, tally);
      }
    }
  }
}

}  // namespace berth::lab
