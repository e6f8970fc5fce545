// berth_study as its user sees it.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/berth_program.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

class Study : public ::testing::Test {
 protected:
  std::int64_t lines() const {
    const fs::path file = folder_ / "out/measurements.csv";
    if (!fs::exists(file)) return 0;
    const std::string bytes = read_file_bytes(file);
    return std::count(bytes.begin(), bytes.end(), '\n');
  }

  bool comes_to_lines(std::int64_t count) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (lines() < count) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }

  const TemporaryFolder folder_;
};

TEST_F(Study, QuickStudyIsStoppedGoesOnAndMakesEveryFile) {
#ifdef BERTH_IS_SLOW_BUILD
  GTEST_SKIP() << "in a release build only: brute force takes minutes in this one";
#endif
  BerthProgram first(folder_.path(), {"--quick", "--out", "out"});
  ASSERT_TRUE(comes_to_lines(50));
  first.interrupt();
  const Outcome stopped = first.wait();
  EXPECT_EQ(stopped.exit_status, 130);
  EXPECT_NE(stopped.err.find("what is complete is kept in out"), std::string::npos) << stopped.err;
  EXPECT_FALSE(fs::exists(folder_ / "out/index.html"));
  const std::int64_t kept = lines() - 1;

  const Outcome other = run_berth(folder_.path(), {"--out", "out"});
  EXPECT_EQ(other.exit_status, 1);
  EXPECT_NE(other.err.find("study.json: extent: \"quick\"; expected \"full\""), std::string::npos)
      << other.err;

  const Outcome done = run_berth(folder_.path(), {"--quick", "--out", "out"});
  EXPECT_EQ(done.exit_status, 0) << done.err;
  EXPECT_NE(done.out.find("; " + std::to_string(kept) + " are there already"), std::string::npos)
      << done.out;
  const std::string check = "/usr/bin/python3 -B " BERTH_SOURCE_DIR
                            "/tests/thesis/study/check_files.py " +
                            (folder_ / "out").string();
  EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(Study, SaysWhatToInstallBeforeItMeasures) {
  // Python finds none of its modules then.
  ::setenv("PYTHONHOME", folder_.path().c_str(), 1);
  const Outcome outcome = run_berth(folder_.path(), {"--quick", "--out", "out"});
  ::unsetenv("PYTHONHOME");
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_NE(outcome.err.find("install Debian's python3-matplotlib"), std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Study, RefusesWhatItCannotUse) {
  struct Wrong {
    std::vector<std::string> arguments;
    int exit_status;
    std::string told;
  };
  const std::string bundled = BERTH_SOURCE_DIR "/data/bundled/one_camera.yaml";
  folder_.write("file", "");
  const std::vector<Wrong> table = {
      {{"--scene", "missing.yaml"}, 1, "missing.yaml"},
      {{"--scene", bundled, "--scene", bundled}, 1, "is there twice"},
      {{"--out", "file"}, 1, "file"},
      {{"--seed", "-1"}, 2, "--seed"},
      {{"--threads", "0"}, 2, "--threads"},
      {{"scene.yaml"}, 2, "scene.yaml"},
      {{"--backend", "vulkan"}, 2, "vulkan"},
      {{"--backend", "opengl", "--gl-device", "no such GPU"}, 1, "OpenGL"},
  };
  for (const Wrong& wrong : table) {
    const Outcome outcome = run_berth(folder_.path(), wrong.arguments);
    EXPECT_EQ(outcome.exit_status, wrong.exit_status) << outcome.err;
    EXPECT_NE(outcome.err.find(wrong.told), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace berth
