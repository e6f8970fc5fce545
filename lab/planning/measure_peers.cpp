// Many configurations of drawn rooms beside what else a planner could ask.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/planning/planning_peer.hpp"

namespace berth::lab {
namespace {

struct Options : RoomOptions {
  std::size_t count = 200;
  double margin_m = 0.03;
};

class Ours : public PlanningPeer {
 public:
  explicit Ours(std::shared_ptr<const Robot> robot) : check_(std::move(robot)) {}
  std::string name() const override { return "ConfigurationCheck"; }
  void build(const FrameList& frames, const Eigen::AlignedBox3d&) override {
    check_.prepare(frames);
  }
  void ask(std::span<const double> positions, double margin_m,
           std::span<Verdict> verdicts) override {
    check_.ask(positions, {.margin_m = margin_m}, verdicts);
  }

 private:
  ConfigurationCheck check_;
};

class Exact : public PlanningPeer {
 public:
  explicit Exact(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {}
  std::string name() const override { return "the exact search, up to the margin"; }
  void build(const FrameList& frames, const Eigen::AlignedBox3d&) override { frames_ = &frames; }
  void ask(std::span<const double> positions, double margin_m,
           std::span<Verdict> verdicts) override {
    std::ranges::copy(MarginSearch(robot_, *frames_, margin_m).ask(positions), verdicts.begin());
  }

 private:
  std::shared_ptr<const Robot> robot_;
  const FrameList* frames_ = nullptr;
};

struct Row {
  std::string name;
  double build_ms = 0, ask_ms = 0;
  std::size_t free_though_near = 0, near_though_free = 0, undecided = 0;
};

/// Of all that is within the margin of the moved links.
Eigen::AlignedBox3d box_of(const RobotModel& model, std::span<const double> positions,
                           double margin_m) {
  Eigen::AlignedBox3d box_B_m;
  RobotPose pose;
  for (const JointState& joints : states_of(positions, model.joints.size())) {
    forward_kinematics(model, joints.position, pose);
    for (const std::size_t link : model.evaluated_links) {
      if (!model.is_moved(link) || model.links[link].mesh_L.empty()) continue;
      const Eigen::AlignedBox3d box_L_m = model.links[link].mesh_L.bounding_box_m().cast<double>();
      box_B_m.extend(box_L_m.transformed(pose.X_BL[link]));
    }
  }
  const Eigen::Vector3d margins_m = Eigen::Vector3d::Constant(margin_m);
  return {box_B_m.min() - margins_m, box_B_m.max() + margins_m};
}

class Comparison {
 public:
  explicit Comparison(const Options& options) : options_(options) {}

  void add(ConfigurationRoom room) {
    const RobotModel& model = room.robot()->model();
    std::vector<double> positions = room.draw(options_.count, true);
    for (const double q : room.draw(options_.count, false)) positions.push_back(q);
    const Eigen::AlignedBox3d box_B_m = box_of(model, positions, options_.margin_m);
    std::vector<std::unique_ptr<PlanningPeer>> peers;
    peers.push_back(std::make_unique<Exact>(room.robot()));
    peers.push_back(std::make_unique<Ours>(room.robot()));
    peers.push_back(make_points_peer(model));
    peers.push_back(make_octomap_peer(model, 0.02, false));
    peers.push_back(make_octomap_peer(model, 0.02, true));
    rows_.resize(peers.size());
    for (std::size_t i = 0; i < peers.size(); ++i)
      run(*peers[i], room, positions, box_B_m, rows_[i]);
    ++rooms_;
  }

  void print() const {
    const auto asked = static_cast<double>(asked_);
    fmt::print(
        "{} configurations in {} rooms, {} cameras, margin {} m: {} certified near, {} certified "
        "free.\n\n| | made for each set of images [ms] | a configuration [us] | called free, "
        "certified near | called near, certified free | undecided |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: |\n",
        asked_, rooms_, options_.view.cameras, options_.margin_m, near_, free_);
    for (const Row& row : rows_) {
      fmt::print("| {} | {:.0f} | {:.2f} | {} | {} | {} |\n", row.name, row.build_ms / rooms_,
                 1000 * row.ask_ms / asked, row.free_though_near, row.near_though_free,
                 row.undecided);
    }
  }

 private:
  void run(PlanningPeer& peer, const ConfigurationRoom& room, const std::vector<double>& positions,
           const Eigen::AlignedBox3d& box_B_m, Row& row) {
    row.name = peer.name();
    const Stopwatch building(CLOCK_THREAD_CPUTIME_ID);
    peer.build(room.frames(), box_B_m);
    row.build_ms += building.ms();
    std::vector<Verdict> verdicts(positions.size() / room.robot()->model().joints.size());
    // What is found once for many is there the second time.
    peer.ask(positions, options_.margin_m, verdicts);
    const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
    peer.ask(positions, options_.margin_m, verdicts);
    row.ask_ms += asking.ms();
    if (&row == &rows_.front()) {
      certified_ = verdicts;
      asked_ += verdicts.size();
      near_ += std::ranges::count(certified_, Verdict::near);
      free_ += std::ranges::count(certified_, Verdict::free);
    }
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      row.undecided += verdicts[i] == Verdict::undecided;
      row.free_though_near += verdicts[i] == Verdict::free && certified_[i] == Verdict::near;
      row.near_though_free += verdicts[i] == Verdict::near && certified_[i] == Verdict::free;
    }
  }

  const Options& options_;
  std::vector<Verdict> certified_;
  std::size_t asked_ = 0, near_ = 0, free_ = 0;
  int rooms_ = 0;
  /// The exact search's first.
  std::vector<Row> rows_;
};

void run(const Options& options) {
  Comparison comparison(options);
  for_each_room(options, [&](const std::shared_ptr<const Robot>& robot, const RoomView& view) {
    comparison.add({robot, view});
    fmt::print(stderr, "room {}\n", view.seed);
  });
  comparison.print();
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  using namespace berth;
  CLI::App program("Asks ConfigurationCheck and its peers about the same configurations.");
  lab::Options options;
  lab::add_room_options(program, options);
  program.add_option("--count", options.count, "configurations of each room, anywhere and near")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  program.add_option("--margin", options.margin_m, "what is near, in m")
      ->check(CLI::Range(0.0, 0.2))
      ->capture_default_str();
  if (const auto status = app::parse_command_line(program, argc, argv)) return *status;
  return app::carry_out("measure_peers", 0, [&] { lab::run(options); });
}
