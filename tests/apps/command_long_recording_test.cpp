// `berth run` of many images reads them as it goes.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "berth/files/file_bytes.hpp"
#include "berth/files/png.hpp"
#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

/// The scene with `images` images, by turns those that it has; the one after `whole` and all behind
/// it are damaged inside.
void make_recording(CommandScene& scene, int images, int whole) {
  std::string damaged = read_file_bytes(scene / "depth/000001.png");
  damaged[damaged.size() / 2] ^= 0x55;
  scene.write("depth/damaged.png", damaged);
  scene.lines.depth = "[";
  scene.lines.more_camera = "stamps: [";
  for (int i = 0; i < images; ++i) {
    const char* comma = i == 0 ? "" : ", ";
    scene.lines.depth += comma + (i < whole ? fmt::format("depth/{:06}.png", i % 3)
                                            : std::string("depth/damaged.png"));
    scene.lines.more_camera += fmt::format("{}{}", comma, i * 0.002);
  }
  scene.lines.depth += "]";
  scene.lines.more_camera += "]";
  // The images do not belong to the joints of their stamps.
  scene.lines.more = "watch: {min_at_robot: 0}\n";
}

int json_lines(const std::string& text) {
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_EQ(Json::parse(line)["frame"], count);
  }
  return count;
}

constexpr int kImages = 300, kWhole = 5;

TEST(LongRecording, AResultIsGivenBeforeTheNextImageIsDecoded) {
  CommandScene scene;
  make_recording(scene, kImages, kWhole);
  for (const std::string command : {"run", "evaluate"}) {
    const Outcome outcome = scene.berth({command, "scene.yaml", "--format", "json"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(json_lines(outcome.out), kWhole);
    EXPECT_NE(outcome.err.find("damaged.png"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("; ended after 5 of 300 images"), std::string::npos) << outcome.err;
  }
}

TEST(LongRecording, WhatIsDoneBeforeADamagedImageIsKept) {
  CommandScene scene;
  make_recording(scene, kImages, kWhole);
  const auto before = scene.all_names();
  const Outcome outcome =
      scene.berth({"run", "scene.yaml", "--format", "json", "--out", "result.jsonl"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(json_lines(read_file_bytes(scene / "result.jsonl")), kWhole);
  EXPECT_TRUE(
      outcome.err.ends_with("; ended after 5 of 300 images; result.jsonl holds 5 results\n"))
      << outcome.err;
  EXPECT_LE(scene.all_names().size(), before.size() + 2);  // with scene.yaml
}

TEST(LongRecording, AMissingCutOrWrongImageIsFoundBeforeTheFirstResult) {
  CommandScene scene;
  make_recording(scene, kImages, kImages);
  const std::string whole = read_file_bytes(scene / "depth/000000.png");
  const auto expect_refused = [&](const std::string& said) {
    const Outcome outcome = scene.berth({"run", "scene.yaml"});
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("last.png: " + said), std::string::npos) << outcome.err;
  };
  scene.lines.depth.replace(scene.lines.depth.rfind("depth/"), std::string::npos,
                            "depth/last.png]");
  expect_refused("No such file");
  scene.write("depth/last.png", whole.substr(0, whole.size() - 20));
  expect_refused("");
  scene.write("depth/last.png", "");
  expect_refused("");
  Image<float> small(8, 8);
  std::fill(small.pixels().begin(), small.pixels().end(), 1.F);
  write_depth_png(scene / "depth/last.png", small, 0.001);
  expect_refused("8 x 8 pixels; expected 64 x 48");
  scene.write("depth/last.png", whole + "behind the end");
  EXPECT_EQ(scene.berth({"run", "scene.yaml"}).exit_status, 0);
}

/// A terminal that nobody looks at; what is written to it can be read here.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    EXPECT_EQ(::grantpt(master_), 0);
    EXPECT_EQ(::unlockpt(master_), 0);
    name_ = ::ptsname(master_);
    // Without somebody who holds it open, what was written goes with its last writer.
    slave_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY);
  }
  ~Terminal() {
    ::close(slave_);
    ::close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  const std::string& name() const { return name_; }
  std::string text() const {
    std::string all(1 << 16, '\0');
    const ssize_t count = ::read(master_, all.data(), all.size());
    all.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    return all;
  }

 private:
  int master_;
  int slave_;
  std::string name_;
};

TEST(LongRecording, ATerminalShowsFromTheStartHowFarItIs) {
  CommandScene scene;
  make_recording(scene, 6, 6);
  scene.write_scene();
  const Terminal terminal;
  BerthProgram run(scene.folder(), {"run", "scene.yaml", "--out", "result.txt"}, terminal.name());
  EXPECT_EQ(run.wait().exit_status, 0);
  const std::string shown = terminal.text();
  std::size_t at = 0;
  for (const char* part :
       {"check images [", "] 0/6", "] 6/6", "run [", "] 0/6", "] 1/6", "] 6/6"}) {
    at = shown.find(part, at);
    ASSERT_NE(at, std::string::npos) << part << "\nin\n" << shown;
  }
}

/// Of a run over `images` images of the bundled scene's first camera.
std::size_t peak_bytes_of(int images) {
  const TemporaryFolder folder;
  std::ostringstream scene;
  const std::string bundled = BERTH_SOURCE_DIR "/data/bundled";
  scene << "robot: {urdf: " << bundled << "/arm/arm.urdf, package_paths: {berth_arm: " << bundled
        << "/arm}, environment_links: [table]}\ncameras:\n  - name: camera\n    info: " << bundled
        << "/camera_info.yaml\n    pose: {parent: table, xyz: [0.120, -2.250, 0.800], "
           "quaternion_xyzw: [-0.788699, 0.073200, -0.056410, 0.607794]}\n    depth: [";
  constexpr int kOnes = 36;
  for (int i = 0; i < images; ++i) {
    scene << (i == 0 ? "" : ", ") << bundled << fmt::format("/depth/{:06}.png", i % kOnes);
  }
  scene << "]\n    stamps: [";
  // All of them within the joints' times; what the robot does meanwhile does not matter here.
  for (int i = 0; i < images; ++i) {
    scene << (i == 0 ? "" : ", ") << fmt::format("{:.5f}", i * 3.5 / images);
  }
  scene << "]\n    watch: {min_at_robot: 0}\njoints: " << bundled
        << "/joints.csv\nevaluation: {visibility: false}\n";
  folder.write("scene.yaml", scene.str());
  const Outcome outcome = run_berth(folder.path(), {"run", "scene.yaml"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  return outcome.peak_bytes;
}

TEST(LongRecording, MemoryDoesNotGrowWithTheNumberOfImages) {
  constexpr std::size_t kImageBytes = std::size_t{640} * 480 * sizeof(float);
  const std::size_t few = peak_bytes_of(12), many = peak_bytes_of(60);
  EXPECT_LT(many, few + 20 * kImageBytes);
  EXPECT_GT(few, 5 * kImageBytes);
}

}  // namespace
}  // namespace berth
