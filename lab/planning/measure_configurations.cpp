// Many configurations of drawn rooms: how quickly, how many stay undecided, and whether the exact
// search says the same.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/planning/configuration_room.hpp"

namespace berth::lab {
namespace {

constexpr std::array<double, 3> kMargins_m{0.01, 0.03, 0.1};
/// Asked at 3 cm, of each kind, for the times and for what stays undecided.
constexpr std::size_t kAsked = 20'000;
/// Of these, by the exact search over its usual range.
constexpr std::size_t kTimed = 10;
/// Of a way that is looked ahead at.
constexpr std::size_t kAhead = 50;
/// Of a motion held against the exact search; the next ones where those before do not show what is
/// near.
constexpr std::array<std::size_t, 3> kPlaces{7, 61, 541};

struct Options : RoomOptions {
  /// Configurations of each room, margin and kind, and motions of each room and margin.
  std::size_t exact = 100;
  std::size_t motions = 10;
  bool is_carrying = false;
};

/// What became of some rooms.
struct Counts {
  /// What was decided and held against the exact search.
  std::size_t asked = 0, held = 0, wrong_free = 0, wrong_near = 0;
  std::size_t motions = 0, held_motions = 0, wrong_free_motions = 0, wrong_near_motions = 0;
  std::vector<double> prepare_ms, random_us, near_us, random_undecided, near_undecided, exact_ms;
  /// Of what is undecided: the exact search alone, and resolve.
  std::vector<double> alone_ms, resolve_ms;
  /// Of a whole way: by the exact search, and by a field, its verdicts and resolve.
  std::vector<double> way_exact_ms, way_ms;
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Straight in joint space.
std::vector<double> way_of(std::span<const double> from, std::span<const double> to,
                           std::size_t places) {
  std::vector<double> way;
  for (std::size_t k = 0; k < places; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(places - 1);
    for (std::size_t j = 0; j < from.size(); ++j) way.push_back(from[j] + (to[j] - from[j]) * part);
  }
  return way;
}

bool is_wrong_free(Verdict said, Verdict exact) {
  return said == Verdict::free && exact == Verdict::near;
}

bool is_wrong_near(Verdict said, Verdict exact) {
  return said == Verdict::near && exact == Verdict::free;
}

class Comparison {
 public:
  Comparison(ConfigurationRoom room, std::size_t joints)
      : room_(std::move(room)), joints_(joints), check_(room_.robot()) {}

  void measure(const Options& options, Counts& counts) {
    check_.prepare(room_.frames());
    const Stopwatch preparing(CLOCK_THREAD_CPUTIME_ID);
    check_.prepare(room_.frames());
    counts.prepare_ms.push_back(preparing.ms());
    time(true, counts, counts.random_us, counts.random_undecided);
    time(false, counts, counts.near_us, counts.near_undecided);
    time_way(counts);
    for (const double margin_m : kMargins_m) {
      MarginSearch exact(room_.robot(), room_.frames(), margin_m);
      for (const bool is_anywhere : {true, false})
        hold(options.exact, margin_m, is_anywhere, exact, counts);
      hold_motions(options.motions, margin_m, exact, counts);
    }
  }

 private:
  std::span<const double> part(std::span<const double> positions, std::size_t first,
                               std::size_t count) const {
    return positions.subspan(joints_ * first, joints_ * count);
  }

  void time(bool is_anywhere, Counts& counts, std::vector<double>& us,
            std::vector<double>& undecided) {
    const std::vector<double> positions = room_.draw(kAsked, is_anywhere);
    std::vector<Verdict> verdicts(kAsked);
    check_.ask(positions, {}, verdicts);
    const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
    check_.ask(positions, {}, verdicts);
    us.push_back(1000 * asking.ms() / kAsked);
    undecided.push_back(static_cast<double>(std::ranges::count(verdicts, Verdict::undecided)) /
                        kAsked);
    time_exact(positions, verdicts, counts);
  }

  void time_exact(std::span<const double> positions, const std::vector<Verdict>& verdicts,
                  Counts& counts) {
    ExactSearch any(room_.robot(), room_.frames());
    any.ask({});
    const Stopwatch asking(CLOCK_THREAD_CPUTIME_ID);
    any.ask(part(positions, 0, kTimed));
    counts.exact_ms.push_back(asking.ms() / kTimed);

    std::vector<double> open;
    for (std::size_t i = 0; i < kAsked && open.size() < joints_ * kTimed; ++i) {
      if (verdicts[i] != Verdict::undecided) continue;
      const auto one = part(positions, i, 1);
      open.insert(open.end(), one.begin(), one.end());
    }
    if (open.empty()) return;
    const double count = static_cast<double>(open.size()) / static_cast<double>(joints_);
    ExactSearch alone(room_.robot(), room_.frames());
    alone.ask({});
    const Stopwatch searching(CLOCK_THREAD_CPUTIME_ID);
    alone.ask(open);
    counts.alone_ms.push_back(searching.ms() / count);
    // So that neither begins with what another one found of unknown space.
    check_.prepare(room_.frames());
    std::vector<Verdict> resolved(static_cast<std::size_t>(count), Verdict::undecided);
    const Stopwatch resolving(CLOCK_THREAD_CPUTIME_ID);
    check_.resolve(open, {}, resolved);
    counts.resolve_ms.push_back(resolving.ms() / count);
  }

  void time_way(Counts& counts) {
    const std::vector<double> way = way_of(room_.draw(1, false), room_.draw(1, false), kAhead);
    ExactSearch exact(room_.robot(), room_.frames());
    exact.ask({});
    const Stopwatch looking(CLOCK_THREAD_CPUTIME_ID);
    exact.ask(way);
    counts.way_exact_ms.push_back(looking.ms());
    std::vector<Verdict> verdicts(kAhead);
    const Stopwatch checking(CLOCK_THREAD_CPUTIME_ID);
    check_.prepare(room_.frames());
    check_.ask(way, {}, verdicts);
    check_.resolve(way, {}, verdicts);
    counts.way_ms.push_back(checking.ms());
  }

  void hold(std::size_t count, double margin_m, bool is_anywhere, MarginSearch& exact,
            Counts& counts) {
    const std::vector<double> positions = room_.draw(count, is_anywhere);
    std::vector<Verdict> verdicts(count);
    check_.ask(positions, {.margin_m = margin_m}, verdicts);
    counts.asked += count;
    std::vector<double> decided;
    for (std::size_t i = 0; i < count; ++i) {
      if (verdicts[i] == Verdict::undecided) continue;
      const auto one = part(positions, i, 1);
      decided.insert(decided.end(), one.begin(), one.end());
    }
    std::erase(verdicts, Verdict::undecided);
    const std::vector<Verdict> found = exact.ask(decided);
    counts.held += found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      counts.wrong_free += is_wrong_free(verdicts[i], found[i]);
      counts.wrong_near += is_wrong_near(verdicts[i], found[i]);
      if (is_wrong_free(verdicts[i], found[i]) || is_wrong_near(verdicts[i], found[i]))
        tell("configuration", margin_m, part(decided, i, 1));
    }
  }

  /// So that it can be asked again.
  static void tell(const char* what, double margin_m, std::span<const double> positions) {
    fmt::print(stderr, "wrong {} at {} m: {}\n", what, margin_m, fmt::join(positions, " "));
  }

  void hold_motions(std::size_t count, double margin_m, MarginSearch& exact, Counts& counts) {
    const std::vector<double> from = room_.draw(count, false);
    std::vector<double> to = from;
    for (double& q : to) q += room_.random()(-0.25, 0.25);
    std::vector<Verdict> verdicts(count);
    check_.ask_motions(from, to, {.margin_m = margin_m}, verdicts);
    counts.motions += count;
    for (std::size_t i = 0; i < count; ++i) {
      if (verdicts[i] == Verdict::undecided) continue;
      ++counts.held_motions;
      const auto begin = part(from, i, 1), end = part(to, i, 1);
      Verdict found = on_way(begin, end, kPlaces.front(), exact);
      for (std::size_t k = 1; k < kPlaces.size() && is_wrong_near(verdicts[i], found); ++k) {
        found = on_way(begin, end, kPlaces[k], exact);
      }
      counts.wrong_free_motions += is_wrong_free(verdicts[i], found);
      counts.wrong_near_motions += is_wrong_near(verdicts[i], found);
      if (!is_wrong_free(verdicts[i], found) && !is_wrong_near(verdicts[i], found)) continue;
      tell("motion from", margin_m, begin);
      tell("motion to", margin_m, end);
    }
  }

  /// Near where one of the places is, free where all are.
  static Verdict on_way(std::span<const double> from, std::span<const double> to,
                        std::size_t places, MarginSearch& exact) {
    const std::vector<Verdict> found = exact.ask(way_of(from, to, places));
    const auto any = [&](Verdict verdict) {
      return std::ranges::find(found, verdict) != found.end();
    };
    if (any(Verdict::near)) return Verdict::near;
    return any(Verdict::undecided) ? Verdict::undecided : Verdict::free;
  }

  ConfigurationRoom room_;
  std::size_t joints_;
  ConfigurationCheck check_;
};

void run(const Options& options) {
  Counts counts;
  for_each_room(options, [&](const std::shared_ptr<const Robot>& robot, const RoomView& view) {
    Comparison({options.is_carrying ? with_rod(*robot) : robot, view}, robot->model().joints.size())
        .measure(options, counts);
    fmt::print(stderr, "room {}: {} held, {} wrongly free, {} wrongly near; {} motions, {}, {}\n",
               view.seed, counts.held, counts.wrong_free, counts.wrong_near, counts.held_motions,
               counts.wrong_free_motions, counts.wrong_near_motions);
  });
  fmt::print(
      "| rooms, cameras | the field [ms] | a configuration [us], anywhere; near | undecided at 3 "
      "cm, anywhere; near [%] | exact search [ms] | undecided: exact search, resolve [ms] | a way "
      "of 50: exact search, field and resolve [ms] | configurations, held | wrongly free, near | "
      "motions, held | wrongly free, near |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  fmt::print(
      "| {}, {}{}{} | {:.0f} | {:.2f}; {:.2f} | {:.1f}; {:.1f} | {:.1f} | {:.2f}, {:.2f} | {:.0f}, "
      "{:.0f} | {}, {} | {}, {} | {}, {} | {}, {} |\n",
      options.rooms, options.view.cameras, options.view.has_errors ? ", sensor model" : "",
      options.is_carrying ? ", carrying" : "", mean(counts.prepare_ms), mean(counts.random_us),
      mean(counts.near_us), 100 * mean(counts.random_undecided), 100 * mean(counts.near_undecided),
      mean(counts.exact_ms), mean(counts.alone_ms), mean(counts.resolve_ms),
      mean(counts.way_exact_ms), mean(counts.way_ms), counts.asked, counts.held, counts.wrong_free,
      counts.wrong_near, counts.motions, counts.held_motions, counts.wrong_free_motions,
      counts.wrong_near_motions);
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  using namespace berth;
  CLI::App program("Holds ConfigurationCheck against the exact search, in drawn rooms.");
  lab::Options options;
  options.rooms = 9;
  lab::add_room_options(program, options);
  program.add_option("--exact", options.exact, "configurations of each room, margin and kind")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  program.add_option("--motions", options.motions, "of each room and margin")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  program.add_flag("--errors", options.view.has_errors, "images of the sensor model");
  program.add_flag("--carrying", options.is_carrying, "the robot holds a rod");
  if (const auto status = app::parse_command_line(program, argc, argv)) return *status;
  return app::carry_out("measure_configurations", 0, [&] { lab::run(options); });
}
