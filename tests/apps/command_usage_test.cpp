// Exit status 2 and nothing on standard output for a wrong command line; help on standard output.
#include <gtest/gtest.h>

#include "tests/apps/berth_program.hpp"

namespace berth {
namespace {

using Words = std::vector<std::string>;

struct WrongUsage {
  Words arguments;
  std::string told;  ///< a part of the message
};

const Words kEvaluate = {"evaluate",   "--camera", "c.yaml",           "--robot-depth", "r.png",
                         "--link-ids", "i.png",    "--obstacle-depth", "f.png"};

Words evaluate_with(const Words& more) {
  Words arguments = kEvaluate;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Usage, WrongCommandLineIsRefused) {
  const std::vector<WrongUsage> table = {
      {{}, "A command is required"},
      {{"fly"}, "fly"},
      {{"--fast"}, "--fast"},
      {{"fly", "run", "scene.yaml"}, "fly"},
      {{"run", "scene.yaml", "filter"}, "filter"},
      {{"run"}, "scene"},
      {{"run", "scene.yaml", "other.yaml"}, "other.yaml"},
      {{"run", "scene.yaml", "--fast"}, "--fast"},
      {{"run", "scene.yaml", "--method", "exact"}, "--method"},
      {{"run", "scene.yaml", "--backend", "opengl"}, "--backend"},
      {{"runn", "scene.yaml"},
       "runn: no such command; expected run (the nearest), or another of demo"},
      {{"run", "scene.yaml", "--frame", "-1"}, "--frame"},
      {{"evaluate", "scene.yaml", "--camera", "c"}, "--camera"},
      {evaluate_with({"--backend", "opengl"}), "--backend"},
      {{"run", "scene.yaml", "--range", "0"}, "--range"},
      {{"run", "scene.yaml", "--range-m", "0"}, "--range-m"},
      {{"run", "scene.yaml", "--range", "near"}, "--range"},
      {{"run", "scene.yaml", "--range"}, "--range"},
      {{"run", "scene.yaml", "--tolerance-m", "-0.001"}, "--tolerance-m"},
      {{"run", "scene.yaml", "--deadline-us", "soon"}, "--deadline-us"},
      {{"run", "scene.yaml", "--threads", "0"}, "--threads"},
      {{"run", "scene.yaml", "--mean-direction", "maybe"}, "--mean-direction"},
      {{"run", "scene.yaml", "--visibility", "50"}, "--visibility"},
      {{"run", "scene.yaml", "--format", "xml"}, "--format"},
      {{"filter", "scene.yaml"}, "--out"},
      {{"filter", "--out", "f"}, "scene"},
      {{"filter", "scene.yaml", "--out", "f", "--range", "1"}, "--range"},
      {{"evaluate"}, "--camera"},
      {{"evaluate", "--camera", "c", "--robot-depth", "r", "--link-ids", "i"}, "--obstacle-depth"},
      {evaluate_with({"--repeat", "0"}), "--repeat"},
      {evaluate_with({"--depth-scale", "0"}), "--depth-scale"},
      {{"evaluate", "s.yaml", "--robot-region-scale", "0.5"},
       "0.5 is neither 0 nor a number from 1 to 1000"},
      {evaluate_with({"--method", "nonsense"}), "nonsense"},
      {evaluate_with({"--visibility", "on"}), "scene excludes"},
      {evaluate_with({"--deadline-us"}), "--deadline-us"},
      {evaluate_with({"--threads", "0"}), "--threads"},
      {evaluate_with({"--region", "cube"}), "--region"},
      {evaluate_with({"--depth-interval", "Cube"}), "--depth-interval"},
      {evaluate_with({"--search-pattern", "zigzag"}), "--search-pattern"},
      {evaluate_with({"--shrinking", "on"}), "--shrinking"},
      {evaluate_with({"--step-x", "0"}), "--step-x"},
      {evaluate_with({"--step-y", "65537"}), "--step-y"},
      {evaluate_with({"--initial-grid-radius-px", "0"}), "--initial-grid-radius-px"},
      {evaluate_with({"--final-grid-radius-px", "two"}), "--final-grid-radius-px"},
      {evaluate_with({"--tile-px", "65"}), "--tile-px"},
      {{"calibrate"}, "scene"},
      {{"calibrate", "scene.yaml"}, "--out"},
      {{"calibrate", "--out", "new.yaml"}, "scene"},
      {{"calibrate", "scene.yaml", "--out"}, "--out"},
      {{"calibrate", "s.yaml", "--out", "n.yaml", "--attached", "maybe"},
       "maybe not in {ask,yes,no}"},
      {{"calibrate", "scene.yaml", "--out", "new.yaml", "--range", "1"}, "--range"},
      {{"calibrate", "scene.yaml", "--out", "new.yaml", "--format", "xml"}, "--format"},
      {{"calibrate", "scene.yaml", "--out", "new.yaml", "--threads", "0"}, "--threads"},
      {{"demo", "--threads", "0"}, "--threads"},
      {{"record"}, "scene"},
      {{"record", "scene.yaml"}, "--out"},
      {{"record", "scene.yaml", "--out", "a.mcap", "--seconds", "0"}, "--seconds"},
      {{"record", "scene.yaml", "--out", "a.mcap", "--on", "clear"}, "--on"},
      {{"replay"}, "file"},
      {{"replay", "a.mcap", "--format", "xml"}, "--format"},
      {{"init"}, "urdf"},
      {{"init", "robot.urdf", "--camera", "pinhole"}, "--camera"},
      {{"init", "robot.urdf", "--package", "parts"}, "--package"},
      {{"doctor"}, "scene"},
      {{"schema"}, "name"},
      {{"schema", "scenes"}, "scenes"},
      {{"demo", "scene.yaml"}, "scene.yaml"},
  };
  const TemporaryFolder folder;
  for (const WrongUsage& wrong : table) {
    const Outcome outcome = run_berth(folder / "", wrong.arguments);
    std::string words;
    for (const std::string& word : wrong.arguments) words += word + " ";
    SCOPED_TRACE("berth " + words + "\n" + outcome.err);
    EXPECT_EQ(outcome.exit_status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(wrong.told), std::string::npos);
    EXPECT_NE(outcome.err.find("--help"), std::string::npos);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(Usage, HelpIsOnStandardOutputAndHasAnExample) {
  const TemporaryFolder folder;
  const std::vector<Words> table = {
      {"--help"},           {"run", "--help"},      {"record", "--help"},    {"replay", "--help"},
      {"filter", "--help"}, {"evaluate", "--help"}, {"calibrate", "--help"}, {"demo", "--help"},
      {"schema", "--help"}};
  for (const Words& arguments : table) {
    const Outcome outcome = run_berth(folder / "", arguments);
    SCOPED_TRACE(arguments[0]);
    EXPECT_EQ(outcome.exit_status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("Example"), std::string::npos);
    EXPECT_NE(outcome.out.find("berth " + (arguments.size() > 1 ? arguments[0] : "run")),
              std::string::npos);
  }
}

TEST(Usage, HelpNamesEveryCommand) {
  const TemporaryFolder folder;
  const std::string out = run_berth(folder / "", {"--help"}).out;
  for (const char* command :
       {"demo", "run", "record", "replay", "filter", "evaluate", "calibrate"}) {
    EXPECT_NE(out.find(command), std::string::npos) << command;
  }
}

TEST(Usage, SettingsOfMethodsThatCompareImagesAreToldByEvaluateAlone) {
  const TemporaryFolder folder;
  const std::string run = run_berth(folder / "", {"run", "--help"}).out;
  EXPECT_NE(run.find("--tolerance-m"), std::string::npos);
  EXPECT_EQ(run.find("--search-pattern"), std::string::npos);
  EXPECT_NE(run_berth(folder / "", {"evaluate", "--help"}).out.find("--search-pattern"),
            std::string::npos);
}

TEST(Usage, HelpShowsValuesWithoutTheOptionParsersChecks) {
  const TemporaryFolder folder;
  for (const char* command : {"run", "calibrate", "evaluate", "init", "demo"}) {
    const std::string out = run_berth(folder / "", {command, "--help"}).out;
    for (const char* leak : {"TEXT", "INT", "FLOAT", "->", ":{", "Excludes"}) {
      EXPECT_EQ(out.find(leak), std::string::npos) << leak << " in\n" << out;
    }
  }
  EXPECT_NE(run_berth(folder / "", {"calibrate", "--help"}).out.find("--attached ask|yes|no"),
            std::string::npos);
  EXPECT_NE(run_berth(folder / "", {"run", "--help"}).out.find("--range-m,--range M"),
            std::string::npos);
}

TEST(Usage, VersionIsANumber) {
  const TemporaryFolder folder;
  const Outcome outcome = run_berth(folder / "", {"--version"});
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_TRUE(!outcome.out.empty() && std::isdigit(static_cast<unsigned char>(outcome.out[0])));
}

}  // namespace
}  // namespace berth
