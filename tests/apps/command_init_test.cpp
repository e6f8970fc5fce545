// `berth init`: a scene to begin with. And what is made of the options: manual pages, completion.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

using Strings = std::vector<std::string>;

Outcome init(const CommandScene& scene, const Strings& more, const std::string& out = "new.yaml") {
  Strings arguments = {"init", "arm.urdf", "--package", "arm_parts=parts", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_berth(scene.folder(), arguments);
}

TEST(Init, TheSceneRunsOnceTheCamerasPoseIsFilledIn) {
  const CommandScene scene;
  for (const std::string camera : {"other", "realsense", "zed", "kinect", "orbbec"}) {
    std::filesystem::remove(scene / "new.yaml");
    const Outcome outcome = init(scene, {"--camera", camera});
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("berth doctor new.yaml"), std::string::npos) << outcome.out;
    std::string text = read_file_bytes(scene / "new.yaml");
    text = std::regex_replace(text, std::regex("pose: .*"), "pose: " + SceneLines().pose);
    scene.write("new.yaml", text);
    const Outcome run = run_berth(scene.folder(), {"run", "new.yaml", "--format", "json"});
    EXPECT_EQ(run.exit_status, 0) << camera << ": " << run.err;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 3);
  }
}

TEST(Init, FindsRobotEnvironmentAndJoints) {
  const CommandScene scene;
  ASSERT_EQ(init(scene, {"--camera", "realsense"}).exit_status, 0);
  const std::string text = read_file_bytes(scene / "new.yaml");
  for (const char* part :
       {"  urdf: arm.urdf\n  package_paths:\n    arm_parts: parts\n",
        "  environment_links: [table, plug]\n",
        "  # Links that get a distance: base, upper, lower, finger\n", "{parent: base, ",
        "#   time,shoulder,elbow\n", "near_m: 0.28\n", "sensor: {speckle_px: 20}\n", "FILL IN"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  }
}

TEST(Init, PathsAreThoseFromTheScenesFolder) {
  const CommandScene scene;
  std::filesystem::create_directory(scene / "cell");
  ASSERT_EQ(init(scene, {}, "cell/new.yaml").exit_status, 0);
  EXPECT_NE(read_file_bytes(scene / "cell/new.yaml").find("  urdf: ../arm.urdf\n"),
            std::string::npos);
}

TEST(Init, OverwritesNothing) {
  const CommandScene scene;
  scene.write("new.yaml", "mine");
  const Outcome outcome = init(scene, {});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.err, "berth: new.yaml: is there already; expected another name for --out\n");
  EXPECT_EQ(read_file_bytes(scene / "new.yaml"), "mine");
}

TEST(Init, ARobotThatCannotBeLoadedLeavesNoScene) {
  const CommandScene scene;
  const Outcome outcome = run_berth(scene.folder(), {"init", "arm.urdf", "--out", "new.yaml"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_NE(outcome.err.find("package \"arm_parts\" is not known"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("; --package NAME=DIR tells one"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scene / "new.yaml"));
}

/// The options that a command's help shows.
Strings options_of(const std::string& command) {
  const TemporaryFolder folder;
  const std::string help = run_berth(folder.path(), {command, "--help"}).out;
  Strings options;
  const std::regex option("--[a-z0-9-]+");
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    const bool begins = line.find_first_not_of(' ') == 2 && line[2] == '-';
    if (begins && std::regex_search(line, found, option)) options.push_back(found[0]);
  }
  return options;
}

TEST(CommandPages, ManualPagesHaveEachOptionOfTheHelp) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_berth(folder.path(), {"write-pages", "share"}).exit_status, 0);
  const std::string program = read_file_bytes(folder / "share/man/man1/berth.1");
  for (const std::string command :
       {"demo", "run", "filter", "calibrate", "evaluate", "view", "init", "doctor"}) {
    EXPECT_NE(program.find(".B " + command + "\n"), std::string::npos) << command;
    std::string page = read_file_bytes(folder / ("share/man/man1/berth-" + command + ".1"));
    page.erase(std::remove(page.begin(), page.end(), '\\'), page.end());
    const Strings options = options_of(command);
    EXPECT_GE(options.size(), 2) << command;
    for (const std::string& option : options) {
      EXPECT_NE(page.find(option), std::string::npos) << command << " " << option;
    }
  }
  EXPECT_EQ(program.find("write"), std::string::npos);
}

/// What bash completes after these words.
std::string completed(const std::filesystem::path& script, const std::string& words, int current) {
  const TemporaryFolder folder;
  const std::string command = "source '" + script.string() + "'; COMP_WORDS=(" + words +
                              "); COMP_CWORD=" + std::to_string(current) +
                              "; _berth; echo \"${COMPREPLY[*]}\" > '" + (folder / "out").string() +
                              "'";
  folder.write("run.sh", command);
  EXPECT_EQ(std::system(("bash '" + (folder / "run.sh").string() + "'").c_str()), 0);
  std::string text = read_file_bytes(folder / "out");
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

TEST(CommandPages, BashCompletesCommandsOptionsAndTheirWords) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_berth(folder.path(), {"write-pages", "share"}).exit_status, 0);
  const auto script = folder / "share/bash-completion/completions/berth";
  EXPECT_EQ(completed(script, "berth d", 1), "demo doctor");
  EXPECT_EQ(completed(script, "berth evaluate --meth", 2), "--method");
  EXPECT_EQ(completed(script, "berth run --format ''", 3), "table json");
  EXPECT_EQ(completed(script, "berth init a.urdf --camera z", 4), "zed");
  EXPECT_EQ(completed(script, "berth filter --met", 2), "");
}

}  // namespace
}  // namespace berth
