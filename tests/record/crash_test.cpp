// What a program that crashed leaves of its recordings.
#include <csignal>
#include <cstdlib>
#include <thread>

#include "tests/record/one_camera_loop.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

using CrashTest = OneCameraLoop;

/// What a replay gave before it threw.
struct Before {
  int requests = 0;
  int different = 0;
  std::string error;
};

Before replay_up_to_its_end(const fs::path& file) {
  Before before;
  before.error = error_message([&] {
    for (Replay again(file); again.next(); ++before.requests) {
      before.different += again.difference().has_value();
    }
  });
  return before;
}

TEST_F(CrashTest, WhatAKilledProgramRecordedIsReplayed) {
  // The child is this program once more, with the folder of its parent.
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  constexpr const char* kFolder = "BERTH_CRASH_TEST_FOLDER";
  ::setenv(kFolder, folder_.path().c_str(), 0);
  const auto killed = [&] {
    fs::remove(folder_.path());
    RecorderSettings with = settings();
    with.file = fs::path(std::getenv(kFolder)) / "stop.mcap";
    const auto black_box = recorder(with);
    for (int i = 0; i < 24; ++i) step(*black_box);
    // Longer than a chunk stays in memory.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    for (int i = 0; i < 24; ++i) step(*black_box);
    std::raise(SIGKILL);
  };
  EXPECT_EXIT(killed(), testing::KilledBySignal(SIGKILL), "");
  ::unsetenv(kFolder);
  ASSERT_EQ(folder_.names(), std::vector<std::string>{"stop.mcap.ring"});
  int requests = 0, files = 0, cut = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "stop.mcap.ring")) {
    const Before before = replay_up_to_its_end(entry.path());
    EXPECT_EQ(before.different, 0) << entry.path();
    requests += before.requests;
    ++files;
    if (before.error.empty()) continue;
    ++cut;
    expect_parts(before.error, {"stop.mcap.ring/0000", "cut off: byte ", "expected all of it"});
  }
  // The last second, and up to a quarter more; only the file that it wrote to is cut off.
  EXPECT_GE(files, 4);
  EXPECT_GE(requests, 10);
  EXPECT_EQ(cut, 1);
}

TEST_F(CrashTest, TheRingOfAProgramThatCrashedIsNotTouched) {
  fs::create_directory(folder_ / "stop.mcap.ring");
  write_file_bytes(folder_ / "stop.mcap.ring/000001.mcap", "as it was");
  RecorderSettings with = settings();
  std::vector<std::string> told;
  with.tell = [&told](const std::string& sentence) { told.push_back(sentence); };
  {
    const auto black_box = recorder(with);
    step(*black_box);
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"stop.mcap.ring", "stop_2.mcap.ring"}));
  }
  ASSERT_EQ(told.size(), 1U);
  expect_parts(told[0], {"stop.mcap.ring", "crashed", "stop_2.mcap.ring"});
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"stop.mcap.ring"});
  EXPECT_EQ(read_file_bytes(folder_ / "stop.mcap.ring/000001.mcap"), "as it was");
  with.most_files = 1;
  expect_parts(error_message([&] { recorder(with); }),
               {"stop.mcap", "1 rings", "crashed", "expected fewer"});
}

TEST_F(CrashTest, ARecordingThatIsCutOffIsReplayedUpToThere) {
  const auto black_box = recorder(settings());
  for (int i = 0; i < 20; ++i) step(*black_box);
  black_box->write();
  black_box->finish();
  const auto size = fs::file_size(file());
  fs::resize_file(file(), size - 10);
  const Before all = replay_up_to_its_end(file());
  EXPECT_GE(all.requests, 10);
  EXPECT_EQ(all.different, 0);
  expect_parts(all.error, {"stop.mcap", "cut off: byte ", "its index ends here"});
  fs::resize_file(file(), size * 3 / 4);
  const Before some = replay_up_to_its_end(file());
  EXPECT_GT(some.requests, 0);
  EXPECT_LT(some.requests, all.requests);
  EXPECT_EQ(some.different, 0);
  expect_parts(some.error, {"cut off: byte ", " bytes should follow, and ", "expected all of it"});
  // Nothing of it can be told to be the same as a whole.
  EXPECT_EQ(error_message([&] { replay(file()); }), some.error);
}

}  // namespace
}  // namespace berth
