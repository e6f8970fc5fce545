// replay: what was recorded, done once more.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/berth/commands.hpp"
#include "apps/berth/speed_changes.hpp"
#include "apps/support/interrupt.hpp"
#include "berth/record/replay.hpp"
#include "berth/results/result_json.hpp"

namespace berth::app {
namespace {

void print_json(const Replay& replay) {
  using Json = nlohmann::ordered_json;
  Json line = {{"schema", "berth/replay/1"}, {"request", replay.number()},
               {"time_s", replay.time_s()},  {"is_same", !replay.difference()},
               {"difference", nullptr},      {"result", Json::parse(result_json(replay.result()))}};
  if (const auto& difference = replay.difference()) {
    line["difference"] = {{"field", difference->field},
                          {"recorded", difference->recorded},
                          {"replayed", difference->replayed}};
  }
  fmt::print("{}\n", line.dump());
  std::fflush(stdout);
}

void tell_lost(const Replay& replay, const std::filesystem::path& file) {
  if (replay.lost_images() + replay.lost_requests() == 0) return;
  fmt::print(stderr,
             "{}: before request {} {} images and {} requests are missing: the disk was too slow\n",
             file.string(), replay.number(), replay.lost_images(), replay.lost_requests());
}

/// What came of the requests.
struct Tally {
  int requests = 0;
  int different = 0;
  std::string first;

  void take(const Replay& replay) {
    ++requests;
    if (replay.difference() && different++ == 0) first = replay.text();
  }
  std::string text() const {
    if (different == 0) {
      return fmt::format("{} requests, and all results as recorded, to the last bit", requests);
    }
    return fmt::format("{} of {} results are not as recorded; the first: {}", different, requests,
                       first);
  }
};

}  // namespace

void replay_command(const ReplayArguments& arguments) {
  Replay replay(arguments.file);
  const bool is_table = arguments.format == OutputFormat::table;
  SpeedChanges changes;
  Tally tally;
  try {
    while (replay.next()) {
      stop_if_interrupted();
      tell_lost(replay, arguments.file);
      is_table ? changes.take(replay.time_s(), replay.result()) : print_json(replay);
      tally.take(replay);
    }
  } catch (const std::runtime_error& error) {
    // A recording that is cut off, as by a crash, has something to tell all the same.
    if (tally.requests == 0) throw;
    throw std::runtime_error(fmt::format("{}; before that: {}", error.what(), tally.text()));
  }
  if (tally.different > 0) {
    throw std::runtime_error(fmt::format("{}: {}", arguments.file.string(), tally.text()));
  }
  if (is_table) fmt::print("{}\n", tally.text());
}

}  // namespace berth::app
