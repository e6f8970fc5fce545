// record and replay, as their user sees them.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/berth_program.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// The bundled scene with a monitor that lets the arm go on now and then.
class CommandRecord : public ::testing::Test {
 protected:
  CommandRecord() {
    fs::copy(BERTH_SOURCE_DIR "/data/bundled", folder_ / "bundled", fs::copy_options::recursive);
    add("scene.yaml",
        "separation: {detection_m: 0.04, not_seen: ignore, no_reading: ignore, human_speed_m_s: "
        "0.1, reaction_time_s: "
        "0.02, deceleration_m_s2: 6, acceleration_m_s2: 1, camera_uncertainty_m: 0.01, "
        "intrusion_m: "
        "0.02}\n");
  }
  void add(const std::string& scene, const std::string& lines) {
    const fs::path file = folder_ / "bundled" / scene;
    write_file_bytes(file, read_file_bytes(file) + lines);
  }
  Outcome run(const std::vector<std::string>& arguments) {
    return run_berth(folder_ / "", arguments);
  }
  bool has(const std::string& name) const { return fs::exists(folder_ / name); }
  void expect_refused(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& told) {
    const std::vector<std::string> before = folder_.names();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(outcome.out, "");
    expect_parts(outcome.err, told);
    EXPECT_EQ(folder_.names(), before);
  }

  TemporaryFolder folder_;
};

TEST_F(CommandRecord, AStopIsRecordedAndReplayed) {
  const Outcome recorded =
      run({"record", "bundled/scene.yaml", "--out", "stop.mcap", "--seconds", "2"});
  EXPECT_EQ(recorded.exit_status, 0) << recorded.err;
  expect_parts(recorded.out, {"stop: ", "reduced to ", " s  "});
  expect_parts(recorded.err, {"stop.mcap: written", "stop_2.mcap: written"});
  ASSERT_TRUE(has("stop.mcap") && has("stop_2.mcap"));
  EXPECT_FALSE(has("stop.mcap.ring"));
  const Outcome replayed = run({"replay", "stop.mcap"});
  EXPECT_EQ(replayed.exit_status, 0) << replayed.err;
  EXPECT_EQ(replayed.err, "");
  expect_parts(replayed.out, {"stop: ", "all results as recorded, to the last bit"});
}

TEST_F(CommandRecord, AlwaysWritesTheWholeRunOnceAndReplayRefusesWhatWasDoneToIt) {
  const Outcome recorded =
      run({"record", "bundled/scene.yaml", "--out", "all.mcap", "--on", "always"});
  EXPECT_EQ(recorded.exit_status, 0) << recorded.err;
  EXPECT_EQ(recorded.err, "all.mcap: written\n");
  const Outcome replayed = run({"replay", "all.mcap", "--format", "json"});
  EXPECT_EQ(replayed.exit_status, 0) << replayed.err;
  std::istringstream lines(replayed.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["schema"], "berth/replay/1");
    EXPECT_EQ(json["request"], count);
    EXPECT_EQ(json["is_same"], true);
    EXPECT_TRUE(json["difference"].is_null());
    EXPECT_EQ(json["result"]["schema"], "berth/result/3");
  }
  EXPECT_EQ(count, 101);

  // Bytes that are not that file any more.
  const std::string bytes = read_file_bytes(folder_ / "all.mcap");
  write_file_bytes(folder_ / "cut.mcap", bytes.substr(0, bytes.size() / 2));
  std::string damaged = bytes;
  damaged[bytes.size() / 2] = static_cast<char>(damaged[bytes.size() / 2] ^ 1);
  write_file_bytes(folder_ / "damaged.mcap", damaged);
  const Outcome cut = run({"replay", "cut.mcap"});
  EXPECT_EQ(cut.exit_status, 1);
  expect_parts(cut.out, {" s  "});
  expect_parts(cut.err, {"cut.mcap: cut off: byte ", "expected all of it; before that: ",
                         " requests, and all results as recorded"});
  expect_refused({"replay", "damaged.mcap"}, {"damaged.mcap", "damaged", "expected"});
  expect_refused({"replay", "bundled/scene.yaml"}, {"scene.yaml", "MCAP", "expected"});
  expect_refused({"replay", "none.mcap"}, {"none.mcap"});
}

TEST_F(CommandRecord, WhatCtrlCLeavesIsReplayedAsRecorded) {
  BerthProgram program(folder_ / "",
                       {"record", "bundled/scene.yaml", "--out", "part.mcap", "--on", "always"});
  for (int i = 0; i < 3000 && !has("part.mcap.ring/000001.mcap"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  program.interrupt();
  const Outcome recorded = program.wait();
  EXPECT_EQ(recorded.exit_status, 130) << recorded.err;
  expect_parts(recorded.err, {"part.mcap: written", "interrupted after "});
  EXPECT_FALSE(has("part.mcap.ring"));
  const Outcome replayed = run({"replay", "part.mcap"});
  EXPECT_EQ(replayed.exit_status, 0) << replayed.err;
}

TEST_F(CommandRecord, SaysWhereNothingStoppedTheRobot) {
  fs::copy(BERTH_SOURCE_DIR "/data/bundled/scene.yaml", folder_ / "bundled/careful.yaml");
  add("careful.yaml", "separation: {no_reading: ignore}\n");
  const Outcome recorded = run({"record", "bundled/careful.yaml", "--out", "none.mcap"});
  EXPECT_EQ(recorded.exit_status, 0) << recorded.err;
  expect_parts(recorded.err, {"Nothing is written", "--on always"});
  EXPECT_FALSE(has("none.mcap"));
}

TEST_F(CommandRecord, RefusesWhatCannotBeRecorded) {
  fs::copy(BERTH_SOURCE_DIR "/data/bundled/scene.yaml", folder_ / "bundled/plain.yaml");
  expect_refused({"record", "bundled/plain.yaml", "--out", "a.mcap"},
                 {"plain.yaml", "separation: missing", "--on always"});
  expect_refused({"record", "bundled/scene.yaml", "--out", "nowhere/a.mcap"},
                 {"nowhere/a.mcap", "cannot be made", "expected"});
  expect_refused({"record", "bundled/none.yaml", "--out", "a.mcap"}, {"none.yaml"});
}

}  // namespace
}  // namespace berth
