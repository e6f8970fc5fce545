// Many configurations of drawn rooms: how quickly, how many stay undecided, and whether the exact
// search says the same.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <array>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/robot/primitives.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/stream/configurations.hpp"
#include "lab/stream/film.hpp"
#include "lab/trust/trial_robots.hpp"
#include "sim/random.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

constexpr std::array<double, 3> kMargins_m{0.01, 0.03, 0.1};
/// Asked at 3 cm, of each kind, for the times and for what stays undecided.
constexpr std::size_t kAsked = 20'000;
/// Of a motion held against the exact search.
constexpr int kPlaces = 20;

struct Options {
  std::filesystem::path robots;
  std::uint32_t first = 1;
  int rooms = 9;
  int cameras = 3;
  /// Configurations of each room, margin and kind, and motions of each room.
  std::size_t exact = 100;
  std::size_t motions = 10;
  bool has_errors = false;
  bool is_carrying = false;
};

/// What became of some rooms.
struct Counts {
  std::size_t held = 0, wrong_free = 0, wrong_near = 0;
  std::size_t motions = 0, wrong_motions = 0;
  std::vector<double> prepare_ms, random_us, near_us, random_undecided, near_undecided, exact_ms;
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::shared_ptr<const Robot> with_rod(const Robot& robot) {
  Attachment rod;
  rod.name = "rod";
  rod.link = robot.model().links[robot.model().evaluated_links.back()].name;
  rod.mesh_A = make_box(Eigen::Vector3d(0.03, 0.03, 0.3));
  return attach(robot, rod);
}

class Room {
 public:
  Room(std::shared_ptr<const Robot> robot, const Options& options, std::uint32_t seed)
      : robot_(options.is_carrying ? with_rod(*robot) : std::move(robot)),
        check_(robot_),
        query_(robot_),
        random_(seed) {
    CameraSettings settings;
    settings.watch.min_at_robot = 0;
    const Film film =
        film_of_room(robot_, settings, {.seed = seed}, static_cast<std::size_t>(options.cameras));
    for (const FilmedCamera& camera : film.cameras) {
      (void)film.joints->at(camera.stamps_s.front(), kAnyGap, joints_);
      DepthImage depth_m = camera.depth_m.front();
      if (options.has_errors) sim::add_errors(sim::kKinectErrors, seed, depth_m);
      auto frame = std::make_shared<Frame>();
      Observer(camera.mounted).observe(depth_m, joints_, *frame);
      frames_.push_back(std::move(frame));
    }
  }

  void measure(const Options& options, Counts& counts) {
    check_.prepare(frames_);
    const Stopwatch preparing(CLOCK_THREAD_CPUTIME_ID);
    check_.prepare(frames_);
    counts.prepare_ms.push_back(preparing.ms());
    time(draw(kAsked, true), counts.random_us, counts.random_undecided);
    time(draw(kAsked, false), counts.near_us, counts.near_undecided);
    for (const double margin_m : kMargins_m) {
      for (const bool is_anywhere : {true, false})
        hold(options.exact, margin_m, is_anywhere, counts);
    }
    hold_motions(options.motions, counts);
  }

 private:
  std::vector<double> draw(std::size_t count, bool is_anywhere) {
    if (is_anywhere) return draw_configurations(robot_->model(), count, random_);
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i) {
      for (const double position : joints_.position) out.push_back(position + random_(-0.4, 0.4));
    }
    return out;
  }

  void time(const std::vector<double>& positions, std::vector<double>& us,
            std::vector<double>& undecided) {
    std::vector<Verdict> verdicts(kAsked);
    check_.ask(positions, {}, verdicts);
    const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
    check_.ask(positions, {}, verdicts);
    us.push_back(1000 * asking.ms() / kAsked);
    undecided.push_back(static_cast<double>(std::ranges::count(verdicts, Verdict::undecided)) /
                        kAsked);
  }

  /// The least distance of all moved links, and the least bound.
  std::array<double, 2> exact(std::vector<double> position) {
    const JointState joints{0, std::move(position)};
    std::array<double, 2> least{std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()};
    for (const LinkResult& link : query_.ask({.frames = frames_, .joints = joints}).links) {
      if (!link.is_moved) continue;
      least[0] = std::fmin(least[0], link.distance_m);
      least[1] = std::fmin(least[1], link.lower_bound_m);
    }
    return least;
  }

  void hold(std::size_t count, double margin_m, bool is_anywhere, Counts& counts) {
    const std::vector<double> positions = draw(count, is_anywhere);
    const std::size_t joints = joints_.position.size();
    std::vector<Verdict> verdicts(count);
    check_.ask(positions, {.margin_m = margin_m}, verdicts);
    for (std::size_t i = 0; i < count; ++i) {
      const auto first = positions.begin() + static_cast<std::ptrdiff_t>(joints * i);
      const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
      const auto [distance_m, bound_m] =
          exact({first, first + static_cast<std::ptrdiff_t>(joints)});
      counts.exact_ms.push_back(asking.ms());
      ++counts.held;
      counts.wrong_free += verdicts[i] == Verdict::free && distance_m <= margin_m;
      counts.wrong_near += verdicts[i] == Verdict::near && bound_m > margin_m;
    }
  }

  void hold_motions(std::size_t count, Counts& counts) {
    const std::vector<double> from = draw(count, false);
    std::vector<double> to = from;
    for (double& q : to) q += random_(-0.25, 0.25);
    std::vector<Verdict> verdicts(count);
    check_.ask_motions(from, to, {}, verdicts);
    const std::size_t joints = joints_.position.size();
    for (std::size_t i = 0; i < count; ++i) {
      ++counts.motions;
      bool is_wrong = false;
      for (int k = 0; verdicts[i] == Verdict::free && k <= kPlaces && !is_wrong; ++k) {
        std::vector<double> at;
        for (std::size_t j = 0; j < joints; ++j) {
          const double begin = from[joints * i + j];
          at.push_back(begin + (to[joints * i + j] - begin) * k / kPlaces);
        }
        is_wrong = exact(at)[0] <= 0.03;
      }
      counts.wrong_motions += is_wrong;
    }
  }

  std::shared_ptr<const Robot> robot_;
  ConfigurationCheck check_;
  Query query_;
  sim::Random random_;
  JointState joints_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

void run(const Options& options) {
  // Times are those of one core.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  Counts counts;
  const std::vector<TrialRobot> robots = load_trial_robots(options.robots);
  for (int i = 0; i < options.rooms; ++i) {
    EvaluationSettings settings;
    settings.visibility = settings.distance.mean_direction = false;
    const auto robot = std::make_shared<const Robot>(
        robots[static_cast<std::size_t>(i) % robots.size()].model, settings);
    const std::uint32_t seed = options.first + static_cast<std::uint32_t>(i);
    Room(robot, options, seed).measure(options, counts);
    fmt::print(stderr, "room {}: {} held, {} wrongly free, {} wrongly near\n", seed, counts.held,
               counts.wrong_free, counts.wrong_near);
  }
  fmt::print(
      "| rooms, cameras | the field [ms] | a configuration [us], anywhere; near | undecided at 3 "
      "cm, "
      "anywhere; near [%] | exact [ms] | held against it | wrongly free, near | motions, wrongly "
      "free |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  fmt::print(
      "| {}, {}{}{} | {:.0f} | {:.2f}; {:.2f} | {:.1f}; {:.1f} | {:.1f} | {} | {}, {} | {}, {} |\n",
      options.rooms, options.cameras, options.has_errors ? ", sensor model" : "",
      options.is_carrying ? ", carrying" : "", mean(counts.prepare_ms), mean(counts.random_us),
      mean(counts.near_us), 100 * mean(counts.random_undecided), 100 * mean(counts.near_undecided),
      mean(counts.exact_ms), counts.held, counts.wrong_free, counts.wrong_near, counts.motions,
      counts.wrong_motions);
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  using namespace berth;
  CLI::App program("Holds ConfigurationCheck against the exact search, in drawn rooms.");
  lab::Options options;
  program.add_option("--robots", options.robots, "a folder of robots, besides the bundled arm")
      ->check(CLI::ExistingDirectory);
  program.add_option("--first", options.first, "the first room's seed")->capture_default_str();
  program.add_option("--rooms", options.rooms, "how many")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  program.add_option("--cameras", options.cameras, "of each room")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  program.add_option("--exact", options.exact, "configurations of each room, margin and kind")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  program.add_option("--motions", options.motions, "of each room")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  program.add_flag("--errors", options.has_errors, "images of the sensor model");
  program.add_flag("--carrying", options.is_carrying, "the robot holds a rod");
  if (const auto status = app::parse_command_line(program, argc, argv)) return *status;
  return app::carry_out("measure_configurations", 0, [&] { lab::run(options); });
}
