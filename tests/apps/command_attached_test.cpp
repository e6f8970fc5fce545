// berth calibrate of a robot that carries what its URDF does not have, as its user sees it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "berth/files/file_bytes.hpp"
#include "berth/scene/open_scene.hpp"
#include "tests/apps/berth_program.hpp"
#include "tests/support/carrying_cell.hpp"
#include "tests/support/coarse_arm.hpp"

namespace berth {
namespace {

using testing::CarryingCell;
using Json = nlohmann::json;

const std::filesystem::path& kArm =
    testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm");
const std::string kMesh = "new.attached.arm_link_7_attached.stl";

Outcome calibrated(const CarryingCell& cell, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {"calibrate", "cell/scene.yaml", "--out", "new.yaml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_berth(cell.folder(), arguments);
}

TEST(AttachedCommand, WithYesTheToolIsAPartOfTheNewScene) {
  const CarryingCell cell(kArm);
  const Outcome outcome =
      calibrated(cell, {"--attached", "yes", "--format", "json", "--report", "report"});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json json = Json::parse(outcome.out);
  EXPECT_TRUE(json.at("attached_refused").is_null());
  ASSERT_EQ(json.at("attached").size(), 1U);
  const Json& part = json["attached"][0];
  EXPECT_EQ(part.at("name"), "arm_link_7_attached");
  EXPECT_EQ(part.at("link"), "arm_link_7");
  EXPECT_EQ(part.at("is_taken"), true);
  EXPECT_GE(part.at("places"), 3);
  EXPECT_GT(part.at("explained_share"), 0.9);

  const OpenScene scene = open_scene(cell / "new.yaml");
  const auto link = scene.robot->model().find_link("arm_link_7_attached");
  ASSERT_TRUE(link);
  EXPECT_EQ(scene.robot->model().links[*link].mesh_L.triangles.size(), part.at("triangles"));
  EXPECT_TRUE(std::filesystem::exists(cell / kMesh));
  const Outcome run = run_berth(cell.folder(), {"run", "new.yaml", "--format", "json"});
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_NE(run.out.find("arm_link_7_attached"), std::string::npos);

  const std::string page = read_file_bytes(cell / "report/index.html");
  EXPECT_NE(page.find("What the robot carries"), std::string::npos);
  for (int k = 0; k < 6; ++k) {
    const std::string picture = fmt::format("camera_1_frame_{:06}_carried.png", k);
    EXPECT_NE(page.find(picture), std::string::npos);
    EXPECT_TRUE(read_file_bytes(cell / ("report/" + picture)).starts_with("\x89PNG"));
  }

  // A part that the scene has is none that its URDF lacks.
  const Outcome again = run_berth(cell.folder(), {"calibrate", "new.yaml", "--out", "again.yaml",
                                                  "--attached", "yes", "--format", "json"});
  ASSERT_EQ(again.exit_status, 0) << again.err;
  EXPECT_TRUE(Json::parse(again.out).at("attached").empty());
  EXPECT_EQ(read_scene(cell / "again.yaml").attached.size(), 1U);
}

TEST(AttachedCommand, WithoutATerminalNothingIsTakenButTold) {
  const CarryingCell cell(kArm);
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"--attached", "ask"}, {"--attached", "no"}}) {
    const Outcome outcome = calibrated(cell, more);
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("carried: arm_link_7 carries something that its URDF does not have"),
              std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("It stays an obstacle. If it is a part of the robot, calibrate with "
                               "--attached yes."),
              std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(cell / kMesh));
    EXPECT_TRUE(read_scene(cell / "new.yaml").attached.empty());
  }
}

TEST(AttachedCommand, ARobotThatCarriesNothingHasNoPart) {
  const CarryingCell cell(kArm, false);
  const Outcome outcome = calibrated(cell, {"--attached", "yes"});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("carried"), std::string::npos) << outcome.out;
  EXPECT_TRUE(read_scene(cell / "new.yaml").attached.empty());
}

TEST(AttachedCommand, TooFewPosesAreTold) {
  const CarryingCell cell(kArm, true, 4);
  const Outcome outcome = calibrated(cell, {"--attached", "yes"});
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("carried: what the robot carries was not looked for: 4 different "
                             "poses of the arm; expected 5 or more"),
            std::string::npos)
      << outcome.out;
}

TEST(AttachedCommand, AnotherAnswerIsWrongUsage) {
  const CarryingCell cell(kArm, true, 4);
  const Outcome outcome = calibrated(cell, {"--attached", "maybe"});
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("--attached"), std::string::npos);
}

TEST(AttachedCommand, AMeshOfTheSceneItselfIsNeverOverwritten) {
  // A scene that names the very file, on another link.
  const CarryingCell cell(kArm, true, 6,
                          "attached: [{link: arm_link_1, mesh: ../" + kMesh + "}]\n");
  const std::string stl = read_file_bytes(kArm / "meshes/arm_link_0.stl");
  cell.write(kMesh, stl);
  const Outcome outcome = calibrated(cell, {"--attached", "yes"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("is a mesh in cell/scene.yaml, which is never overwritten; expected "
                             "--out of another name"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(read_file_bytes(cell / kMesh), stl);
  EXPECT_FALSE(std::filesystem::exists(cell / "new.yaml"));
}

}  // namespace
}  // namespace berth
