#include "berth/record/replay.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "berth/record/depth_message.hpp"
#include "berth/record/mcap_reader.hpp"
#include "berth/record/recorded_cell.hpp"
#include "berth/record/replayed_cell.hpp"
#include "berth/results/result_json.hpp"

namespace berth {
namespace {

using Json = nlohmann::ordered_json;

/// Such as "[arm_link_3]" for a link's part in a list, else "[2]".
std::string place_text(const Json& element, std::size_t i) {
  for (const char* name : {"link", "camera"}) {
    if (element.is_object() && element.contains(name) && element[name].is_string()) {
      return fmt::format("[{}]", element[name].get<std::string>());
    }
  }
  return fmt::format("[{}]", i);
}

std::optional<ReplayDifference> compare(const std::string& field, const Json& a, const Json& b) {
  if (a == b && a.dump() == b.dump()) return std::nullopt;
  if (a.is_object() && b.is_object()) {
    const std::string before = field.empty() ? "" : field + ".";
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) return ReplayDifference{before + key, value.dump(), "nothing"};
      if (const auto found = compare(before + key, value, b[key])) return found;
    }
    for (const auto& [key, value] : b.items()) {
      if (!a.contains(key)) return ReplayDifference{before + key, "nothing", value.dump()};
    }
  }
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (const auto found = compare(field + place_text(a[i], i), a[i], b[i])) return found;
    }
  }
  return ReplayDifference{field, a.dump(), b.dump()};
}

/// The first field in which two results differ, as JSON; none where they are equal to the last bit.
/// Throws std::exception where one is no JSON.
std::optional<ReplayDifference> first_difference(const std::string& recorded,
                                                 const std::string& replayed) {
  if (recorded == replayed) return std::nullopt;
  return compare("", Json::parse(recorded), Json::parse(replayed));
}

}  // namespace

struct Replay::Parts {
  explicit Parts(const std::filesystem::path& path)
      : file(path), cell(read_cell(file)), again(cell), exposures(cell.cameras.size()) {}

  /// Whether it completes a request.
  bool take(const mcap::Message& message);
  void take_image(std::size_t camera, std::uint16_t which, std::string_view data);
  void ask(std::string_view recorded_result);

  mcap::FileReader file;
  RecordedCell cell;
  ReplayedCell again;
  /// Those whose image follows.
  std::vector<std::optional<RecordedExposure>> exposures;
  std::optional<RecordedRequest> request;
  RecordedBegin begin;
  /// Of the request before; none: there was none.
  std::optional<std::int64_t> number_before;
  std::int64_t number = 0;
  double time_s = 0;
  Result result;
  std::string recorded;
  std::optional<ReplayDifference> difference;
  bool is_stopped = false;
};

void Replay::Parts::take_image(std::size_t camera, std::uint16_t which, std::string_view data) {
  if (which == kExposureOfCamera) {
    exposures[camera] = exposure_of(data);
    return;
  }
  const DepthImage depth_m = depth_of_message(data);
  if (which == kBackgroundOfCamera) return again.set_background(camera, depth_m);
  if (!exposures[camera]) throw std::runtime_error("an image without its exposure");
  again.observe(camera, *exposures[camera], depth_m);
  exposures[camera].reset();
}

void Replay::Parts::ask(std::string_view recorded_result) {
  if (!request) throw std::runtime_error("a result without its request");
  number = request->number;
  const std::int64_t next = number_before.value_or(number) + 1 + begin.lost_requests;
  if (number_before && number != next) {
    throw std::runtime_error(fmt::format("request {} follows request {}; expected request {}",
                                         number, *number_before, next));
  }
  number_before = number;
  is_stopped = request->is_stopped;
  result = again.ask(*request);
  recorded = recorded_result;
  difference = first_difference(recorded, result_json(result));
  request.reset();
}

bool Replay::Parts::take(const mcap::Message& message) {
  if (message.channel == kBeginChannel) {
    begin = begin_of(message.data);
    again.begin(begin);
  } else if (message.channel == kRequestChannel) {
    if (request) throw std::runtime_error(fmt::format("request {} has no result", request->number));
    request = request_of(message.data);
  } else if (message.channel == kResultChannel) {
    ask(message.data);
    return true;
  } else if (message.channel >= kCameraChannel) {
    const auto which = static_cast<std::uint16_t>(message.channel - kCameraChannel);
    const std::size_t camera = which / kCameraChannels;
    if (camera < exposures.size()) take_image(camera, which % kCameraChannels, message.data);
  }
  return false;
}

Replay::Replay(const std::filesystem::path& file) : parts_(std::make_unique<Parts>(file)) {}
Replay::~Replay() = default;

bool Replay::next() {
  Parts& p = *parts_;
  p.begin = {};
  mcap::Message message;
  while (p.file.next(message)) {
    try {
      p.time_s = static_cast<double>(message.time_ns) / 1e9;
      if (p.take(message)) return true;
    } catch (const std::exception& error) {
      p.file.fail_with(fmt::format("at {:.3f} s", p.time_s), error.what());
    }
  }
  if (p.request) p.file.fail_with(fmt::format("request {}", p.request->number), "has no result");
  if (!p.number_before) p.file.fail("no request is in it", "one at least");
  return false;
}

std::int64_t Replay::number() const { return parts_->number; }
double Replay::time_s() const { return parts_->time_s; }
const Result& Replay::result() const { return parts_->result; }
const std::string& Replay::recorded() const { return parts_->recorded; }
const std::optional<ReplayDifference>& Replay::difference() const { return parts_->difference; }
std::int64_t Replay::lost_images() const { return parts_->begin.lost_images; }
std::int64_t Replay::lost_requests() const { return parts_->begin.lost_requests; }

std::string Replay::text() const {
  const Parts& p = *parts_;
  if (!p.difference) return "";
  std::string text =
      fmt::format("request {}, {:.3f} s: {}: recorded {}, replayed {}", p.number, p.time_s,
                  p.difference->field, p.difference->recorded, p.difference->replayed);
  if (p.cell.version != BERTH_VERSION) {
    text += fmt::format("; recorded by berth {}, replayed by {}", p.cell.version, BERTH_VERSION);
  }
  if (p.is_stopped) text += "; it was stopped early, and what that cut short is not found again";
  if (p.cell.had_deadline) {
    text += "; it had a deadline (deadline_us), and what that cut short is not found again";
  }
  return text;
}

ReplaySummary replay(const std::filesystem::path& file) {
  ReplaySummary summary;
  for (Replay again(file); again.next();) {
    ++summary.requests;
    summary.lost_images += again.lost_images();
    summary.lost_requests += again.lost_requests();
    if (!again.difference()) continue;
    if (summary.different++ == 0) summary.first_difference = again.text();
  }
  return summary;
}

}  // namespace berth
