// What berth_bench --stream prints, and refuses.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lab/stream/configurations.hpp"
#include "lab/stream/stream.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::lab {
namespace {

constexpr const char* kScene = BERTH_SOURCE_DIR "/data/bundled/scene.yaml";

std::vector<std::string> keys_of(const nlohmann::ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

/// Each number is one, or none where nothing was measured, and they rise from one to the next.
void expect_percentiles(const nlohmann::ordered_json& out, const std::vector<std::string>& names) {
  EXPECT_EQ(keys_of(out), names);
  double before = 0;
  for (const auto& [name, value] : out.items()) {
    if (value.is_null()) continue;
    EXPECT_GE(value.get<double>(), before) << name;
    before = value.get<double>();
  }
}

TEST(RunStream, ItsJsonHasTheKeysThatOthersRead) {
  const StreamSettings settings{.scene = kScene, .cameras = 2, .seconds = 0.5, .as_json = true};
  const auto out = nlohmann::ordered_json::parse(run_stream(settings));
  EXPECT_EQ(keys_of(out), (std::vector<std::string>{"answers_per_s", "ok_share", "ask_us",
                                                    "image_ms", "exposure_to_answer_ms", "gap_m"}));
  EXPECT_GT(out["answers_per_s"].get<double>(), 0);
  EXPECT_LE(out["answers_per_s"].get<double>(), 1100);
  EXPECT_GE(out["ok_share"].get<double>(), 0);
  EXPECT_LE(out["ok_share"].get<double>(), 1);
  expect_percentiles(out["ask_us"], {"p50", "p99", "p999", "max"});
  expect_percentiles(out["image_ms"], {"p50", "p99"});
  expect_percentiles(out["exposure_to_answer_ms"], {"p50", "p99"});
  expect_percentiles(out["gap_m"], {"p50", "p99", "max"});
  EXPECT_GT(out["ask_us"]["p50"].get<double>(), 0);
  EXPECT_GT(out["image_ms"]["p50"].get<double>(), 0);
}

TEST(RunStream, RecordsItselfWhereThatIsAskedFor) {
  const TemporaryFolder folder;
  const StreamSettings settings{.scene = kScene,
                                .cameras = 1,
                                .rate_hz = 200,
                                .seconds = 0.3,
                                .record = folder / "a.mcap",
                                .as_json = true};
  const auto out = nlohmann::ordered_json::parse(run_stream(settings));
  EXPECT_EQ(keys_of(out["recorded"]),
            (std::vector<std::string>{"images", "requests", "lost_images", "lost_requests"}));
  EXPECT_GT(out["recorded"]["requests"].get<int>(), 0);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.mcap"});
}

TEST(RunStream, APlannerAsksBesideIt) {
  const StreamSettings settings{
      .scene = kScene, .cameras = 1, .seconds = 0.5, .plans_hz = 10, .as_json = true};
  const auto out = nlohmann::ordered_json::parse(run_stream(settings));
  EXPECT_EQ(keys_of(out),
            (std::vector<std::string>{"answers_per_s", "ok_share", "ask_us", "image_ms",
                                      "exposure_to_answer_ms", "gap_m", "plan_ms"}));
  expect_percentiles(out["plan_ms"], {"p50", "max"});
  EXPECT_GT(out["plan_ms"]["max"].get<double>(), 1) << "no field was made";
}

TEST(RunStream, ItsTextHasALineForEach) {
  const std::string out = run_stream({.scene = kScene, .cameras = 1, .seconds = 0.1});
  EXPECT_EQ(out.find("answers_per_s: "), 0U);
  EXPECT_EQ(std::ranges::count(out, '\n'), 6);
}

TEST(RunStream, InStepsItTellsWhatEachOneCostsInADrawnRoom) {
  StreamSettings settings{
      .scene = kScene, .cameras = 1, .rate_hz = 100, .seconds = 0.3, .as_json = true};
  settings.room = {.seed = 2, .width_px = 160, .height_px = 120};
  settings.in_steps = true;
  const auto out = nlohmann::ordered_json::parse(run_stream(settings));
  EXPECT_EQ(keys_of(out), (std::vector<std::string>{
                              "observe_ms", "prepare_ms", "first_us", "next_us", "known_us",
                              "filter_us", "next_with_all_us", "in_budget_us", "in_budget_gap_m"}));
  for (const auto& [step, values] : out.items()) {
    expect_percentiles(values, {"p50", "p95", "p99", "max"});
    EXPECT_GT(values["max"].get<double>(), 0) << step;
  }
}

TEST(RunStream, WhatItCannotPlayItNames) {
  const auto message = [](const StreamSettings& settings) {
    return error_message<std::runtime_error>([&] { run_stream(settings); });
  };
  expect_parts(message({.scene = "no/such/scene.yaml"}), {"no/such/scene.yaml"});
  expect_parts(message({.scene = kScene, .cameras = 4}),
               {"scene.yaml", "3 cameras", "--cameras 4"});
}

TEST(RunConfigurations, TheExactSearchAgreesInTheSceneAndInARoom) {
  StreamSettings settings{.scene = kScene, .as_json = true};
  for (const bool is_room : {false, true}) {
    if (is_room) settings.room = {.seed = 3, .width_px = 160, .height_px = 120};
    const auto json = nlohmann::json::parse(run_configurations(settings, {.count = 500}));
    EXPECT_EQ(json["wrong"], 0);
    EXPECT_GT(json["compared"], 100);
    EXPECT_GT(json["free_share"], 0);
    EXPECT_LT(json["undecided_share"], 0.5);
    EXPECT_GT(json["configurations_per_s"], json["ahead_per_s"]);
    EXPECT_GT(json["field_ms"], 0);
    EXPECT_LT(json["resolve_by_exact"], 2);
  }
}

}  // namespace
}  // namespace berth::lab
