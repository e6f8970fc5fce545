// Ctrl-C: exit status 130, no file left half-written, what is done is kept.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <sstream>
#include <thread>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

constexpr int kManyFrames = 5000;

/// Far more frames than berth can draw before a test interrupts it.
void make_long(CommandScene& scene) {
  // One image again and again is a dead camera.
  scene.lines.more += "watch: {min_at_robot: 0}\n";
  scene.lines.depth = "[depth/000000.png";
  scene.lines.more_camera = "stamps: [0";
  for (int i = 1; i < kManyFrames; ++i) {
    scene.lines.depth += ", depth/000000.png";
    scene.lines.more_camera += ", " + std::to_string(i * 0.0003);
  }
  scene.lines.depth += "]";
  scene.lines.more_camera += "]";
  scene.write_scene();
}

bool becomes_true(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// No result and no temporary file beside the scene's own.
void expect_nothing_new(std::vector<std::string> before, const CommandScene& scene,
                        const std::string& allowed_folder) {
  for (const std::string& name : scene.all_names()) {
    if (std::find(before.begin(), before.end(), name) != before.end()) continue;
    const bool allowed = name == allowed_folder ||
                         (name.starts_with(allowed_folder + "/") && name.ends_with(".png"));
    EXPECT_TRUE(allowed) << name;
  }
}

TEST(Interrupt, RunKeepsWhatIsDoneAndTellsHowMuch) {
  CommandScene scene;
  make_long(scene);
  const auto before = scene.all_names();
  BerthProgram run(scene.folder(), {"run", "scene.yaml", "--format", "json", "--out",
                                    "result.jsonl", "--picture", "pictures"});
  ASSERT_TRUE(becomes_true([&] { return fs::exists(scene / "pictures/frame_000001.png"); }));
  run.interrupt();
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_status, 130);
  EXPECT_EQ(outcome.out, "");
  std::istringstream lines(read_file_bytes(scene / "result.jsonl"));
  int results = 0;
  for (std::string line; std::getline(lines, line); ++results) {
    EXPECT_EQ(Json::parse(line)["frame"], results);
  }
  EXPECT_GE(results, 2);
  // The picture of the last one may be missing.
  const auto told = [&](int images) {
    return fmt::format("berth: interrupted after {} of {} images; result.jsonl holds {} results\n",
                       images, kManyFrames, results);
  };
  EXPECT_TRUE(outcome.err == told(results) || outcome.err == told(results - 1)) << outcome.err;
  fs::remove(scene / "result.jsonl");
  expect_nothing_new(before, scene, "pictures");
}

TEST(Interrupt, PrintedLinesAreWholeJsonObjects) {
  CommandScene scene;
  make_long(scene);
  BerthProgram run(scene.folder(),
                   {"run", "scene.yaml", "--format", "json", "--picture", "pictures"});
  ASSERT_TRUE(becomes_true([&] { return fs::exists(scene / "pictures/frame_000002.png"); }));
  run.interrupt();
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_status, 130);
  ASSERT_TRUE(outcome.out.ends_with("\n"));
  std::istringstream lines(outcome.out);
  int frames = 0;
  for (std::string line; std::getline(lines, line); ++frames) {
    EXPECT_EQ(Json::parse(line)["frame"], frames);
  }
  EXPECT_GE(frames, 2);
  EXPECT_LT(frames, kManyFrames);
}

TEST(Interrupt, FilterLeavesWholeImagesOnly) {
  CommandScene scene;
  make_long(scene);
  const auto before = scene.all_names();
  BerthProgram filter(scene.folder(), {"filter", "scene.yaml", "--out", "filtered"});
  ASSERT_TRUE(becomes_true([&] { return fs::exists(scene / "filtered/link_ids_000000.png"); }));
  filter.interrupt();
  EXPECT_EQ(filter.wait().exit_status, 130);
  expect_nothing_new(before, scene, "filtered");
  // The images of a frame belong together.
  const auto count = [&](const std::string& kind) {
    const auto names = scene.all_names();
    return std::count_if(names.begin(), names.end(), [&](const std::string& name) {
      return name.starts_with("filtered/" + kind);
    });
  };
  EXPECT_EQ(count("robot_depth"), count("link_ids"));
  EXPECT_EQ(count("robot_depth"), count("obstacle_depth"));
  EXPECT_LT(count("robot_depth"), kManyFrames);
}

TEST(Interrupt, IsHeardWhileTheImagesAreRead) {
  CommandScene scene;
  // The last image is one that berth would complain about, once it decodes it.
  make_long(scene);
  std::string damaged = read_file_bytes(scene / "depth/000001.png");
  damaged[damaged.size() / 2] ^= 0x55;
  scene.write("damaged.png", damaged);
  scene.lines.depth.replace(scene.lines.depth.rfind("depth/"), std::string::npos, "damaged.png]");
  scene.write_scene();
  const int events = ::inotify_init1(IN_CLOEXEC);
  ASSERT_GE(::inotify_add_watch(events, (scene / "depth/000000.png").c_str(), IN_OPEN), 0);
  BerthProgram run(scene.folder(), {"run", "scene.yaml"});
  pollfd opened{events, POLLIN, 0};
  ASSERT_EQ(::poll(&opened, 1, 30'000), 1);
  run.interrupt();
  ::close(events);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.exit_status, 130) << outcome.err;
}

}  // namespace
}  // namespace berth
