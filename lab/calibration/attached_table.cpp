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

constexpr std::array kCompanyNames = {"a person, elsewhere in each pose",
                                      "a person who follows the tip",
                                      "a hand that guides the tip",
                                      "a table rolled in under the tip",
                                      "another robot",
                                      "another robot in the same poses"};

bool is_taken(const TrialRobot& robot, const std::string& only) {
  return std::ranges::find(kRobots, std::string_view(robot.name)) != kRobots.end() &&
         robot.name.find(only) != std::string::npos;
}

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
          if (!is_taken(robot, only)) continue;
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

void measure_company(const std::vector<TrialRobot>& robots, const std::string& only, int seeds) {
  fmt::print(
      "| beside a robot that carries nothing | cells | with a part | refused |\n"
      "| --- | ---: | ---: | ---: |\n");
  for (std::size_t i = 0; i < sim::kDrawnCompany.size(); ++i) {
    int cells = 0, with_part = 0, refused = 0;
    for (const TrialRobot& robot : robots) {
      if (!is_taken(robot, only)) continue;
      for (int k = 0; k < 2 * seeds; ++k) {
        const bool is_small = k % 2 == 0;
        const AttachedParts found =
            try_company(robot.model, robot.meshes, sim::kDrawnCompany[i], is_small ? 5 : 8,
                        is_small ? 1 : 2, static_cast<std::uint32_t>(1 + k / 2));
        ++cells;
        with_part += !found.parts.empty();
        refused += !found.refused.empty();
      }
    }
    fmt::print("| {} | {} | {} | {} |\n", kCompanyNames[i], cells, with_part, refused);
    std::fflush(stdout);
  }
}

}  // namespace berth::lab
