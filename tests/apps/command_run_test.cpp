// `berth run`: what it prints and writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/berth_program.hpp"
#include "tests/apps/command_scene.hpp"
#include "tests/apps/refusal.hpp"
#include "tests/support/data_folder.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

Eigen::Vector3d vector_of(const Json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

std::set<std::string> keys_of(const Json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

constexpr const char* kPngSignature = "\x89PNG\r\n\x1a\n";

TEST(Run, JsonHasTheKeysOfTheSchemaAndNoOthers) {
  const std::vector<Json> frames = CommandScene().run();
  ASSERT_EQ(frames.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    const Json& frame = frames[i];
    EXPECT_EQ(keys_of(frame),
              (std::set<std::string>{"schema", "frame", "stamp_s", "joints_stamp_s", "status",
                                     "time", "method", "range_m", "nearest", "cameras", "links"}));
    EXPECT_EQ(
        keys_of(frame["cameras"][0]),
        (std::set<std::string>{"camera", "frame", "stamp_s", "age_s", "status", "seen_through",
                               "displacement_m", "at_robot", "unread_share", "self_filter"}));
    EXPECT_EQ(frame["status"], "ok");
    EXPECT_EQ(keys_of(frame["time"]),
              (std::set<std::string>{"status", "frame_age_s", "joints_age_s", "skew_s"}));
    EXPECT_EQ(frame["time"]["status"], "ok");
    EXPECT_EQ(frame["time"]["skew_s"], 0);
    EXPECT_TRUE(frame["time"]["frame_age_s"].is_null());
    EXPECT_EQ(frame["schema"], "berth/result/3");
    EXPECT_EQ(frame["frame"], i);
    EXPECT_EQ(frame["stamp_s"], i);
    EXPECT_EQ(frame["cameras"][0]["camera"], "front");
    EXPECT_EQ(frame["method"], "mesh");
    EXPECT_EQ(frame["range_m"], 2);
    for (const Json& link : frame["links"]) {
      EXPECT_EQ(keys_of(link), (std::set<std::string>{"id",
                                                      "link",
                                                      "is_moved",
                                                      "status",
                                                      "distance_m",
                                                      "lower_bound_m",
                                                      "robot_point_base_m",
                                                      "obstacle_point_base_m",
                                                      "camera",
                                                      "obstacle_pixel",
                                                      "obstacle_is",
                                                      "occupied",
                                                      "known",
                                                      "assumed_thinner_m",
                                                      "mean_direction_base",
                                                      "mean_direction_camera",
                                                      "mean_count",
                                                      "robot_point_camera_m",
                                                      "obstacle_point_camera_m",
                                                      "visibility"}));
    }
  }
}

TEST(Run, LinksAreThoseWithGeometryExceptEnvironmentNumberedFromOne) {
  const Json frame = CommandScene().run().at(0);
  std::vector<std::string> names;
  for (const Json& link : frame["links"]) {
    names.push_back(link["link"]);
    EXPECT_EQ(link["id"], names.size());
  }
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()),
            (std::set<std::string>{"base", "upper", "lower", "finger", "plug"}));
  EXPECT_EQ(names.size(), 5U);
}

TEST(Run, DistanceIsThatOfItsTwoPointsInBothFrames) {
  const Pose X_BC = front_pose();
  for (const Json& frame : CommandScene().run()) {
    for (const std::string name : {"base", "upper", "lower", "finger"}) {
      const Json link = link_of(frame, name);
      ASSERT_EQ(link["status"], "ok") << name;
      const Eigen::Vector3d robot_C = vector_of(link["robot_point_camera_m"]);
      const Eigen::Vector3d obstacle_C = vector_of(link["obstacle_point_camera_m"]);
      const double distance_m = link["distance_m"];
      EXPECT_NEAR((obstacle_C - robot_C).norm(), distance_m, 1e-5);
      EXPECT_LT((X_BC * robot_C - vector_of(link["robot_point_base_m"])).norm(), 1e-5);
      EXPECT_LT((X_BC * obstacle_C - vector_of(link["obstacle_point_base_m"])).norm(), 1e-5);
    }
  }
}

TEST(Run, NumberOfThreadsChangesNoByte) {
  const CommandScene scene;
  const Outcome one = scene.berth({"run", "scene.yaml", "--format", "json", "--threads", "1"});
  const Outcome two = scene.berth({"run", "scene.yaml", "--format", "json", "--threads", "2"});
  EXPECT_EQ(one.exit_status, 0);
  EXPECT_EQ(one.out, two.out);
  EXPECT_EQ(one.out, scene.berth({"run", "scene.yaml", "--format", "json"}).out);
}

TEST(Run, VisibilityOffLeavesItOutOfJsonAndTableAndChangesNothingElse) {
  const CommandScene scene;
  std::vector<Json> on = scene.json({"run", "scene.yaml", "--visibility", "on"});
  EXPECT_EQ(on, scene.run());
  for (Json& frame : on) {
    for (Json& link : frame["links"]) EXPECT_EQ(link.erase("visibility"), 1U);
  }
  EXPECT_EQ(on, scene.json({"run", "scene.yaml", "--visibility", "off"}));
  EXPECT_NE(scene.berth({"run", "scene.yaml"}).out.find("  seen\n"), std::string::npos);
  EXPECT_EQ(scene.berth({"run", "scene.yaml", "--visibility", "off"}).out.find("  seen\n"),
            std::string::npos);
}

TEST(Run, TableHasALineForEachLinkOfEachFrame) {
  const CommandScene scene;
  const Outcome outcome = scene.berth({"run", "scene.yaml"});
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const std::string word :
       {"frame 0", "frame 1", "frame 2", "camera front", "method mesh", "range 2 m", "distance [m]",
        "base", "upper", "lower", "finger", "plug", "not_seen"}) {
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  }
  // Per frame a title, the table's header, five links and an empty line; then one of them all.
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3 * 8 + 1);
  EXPECT_NE(outcome.out.find("\nThe closest approach in 3 images is in frame "), std::string::npos)
      << outcome.out;
}

TEST(Run, OutFileHoldsWhatElseWouldBePrinted) {
  const CommandScene scene;
  const Outcome printed = scene.berth({"run", "scene.yaml", "--format", "json"});
  scene.write("result.jsonl", "of yesterday");
  const Outcome written =
      scene.berth({"run", "scene.yaml", "--format", "json", "--out", "result.jsonl"});
  EXPECT_EQ(written.exit_status, 0) << written.err;
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read_file_bytes(scene / "result.jsonl"), printed.out);
}

TEST(Run, PicturesAreDrawnIntoANewFolder) {
  const CommandScene scene;
  std::vector<std::string> names = scene.all_names();
  const Outcome outcome = scene.berth({"run", "scene.yaml", "--picture", "a/pictures"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  for (const std::string name : {"frame_000000.png", "frame_000001.png", "frame_000002.png"}) {
    names.push_back("a/pictures/" + name);
    EXPECT_TRUE(read_file_bytes(scene / names.back()).starts_with(kPngSignature)) << name;
  }
  names.insert(names.end(), {"a", "a/pictures"});
  std::sort(names.begin(), names.end());
  EXPECT_EQ(scene.all_names(), names);
}

/// Another camera in the same place, with two of its images.
void add_second_camera(CommandScene& scene) {
  scene.lines.more_cameras =
      "  - {name: again, info: camera_info.yaml, depth: [depth/000000.png, depth/000001.png], "
      "stamps: [0, 1], pose: " +
      scene.lines.pose + "}\n";
}

TEST(Run, SeveralCamerasGiveALineForEachStampAndAFolderOfPicturesEach) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_camera = "stamps: [0]";
  add_second_camera(scene);
  const std::vector<Json> lines = scene.json({"run", "scene.yaml", "--picture", "pictures"});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["cameras"][0]["frame"], 0);
  EXPECT_EQ(lines[0]["cameras"][1]["frame"], 0);
  EXPECT_EQ(lines[1]["cameras"][0]["status"], "too_old");
  EXPECT_EQ(lines[1]["cameras"][1]["frame"], 1);
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/front/frame_000000.png"));
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/again/frame_000001.png"));
}

/// A camera that exposes between the images of the first one.
void add_camera_out_of_step(CommandScene& scene) {
  add_second_camera(scene);
  std::string& lines = scene.lines.more_cameras;
  lines.replace(lines.find("[0, 1]"), 6, "[0.05, 1]");
  scene.lines.more_camera = "stamps: [0, 1, 2]";
}

TEST(Run, OneFrameOnRequestIsThatOfTheWholeRunDrawnInEachCamera) {
  CommandScene scene;
  add_camera_out_of_step(scene);
  const std::vector<Json> all = scene.json({"run", "scene.yaml"});
  ASSERT_EQ(all.size(), 4U);
  const std::vector<Json> one =
      scene.json({"run", "scene.yaml", "--picture", "pictures", "--frame", "1"});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0], all[1]);
  EXPECT_EQ(one[0]["cameras"][0]["frame"], 0);
  for (const char* camera : {"front", "again"}) {
    const auto folder = scene / "pictures" / camera;
    EXPECT_TRUE(std::filesystem::exists(folder / "frame_000001.png")) << camera;
    EXPECT_FALSE(std::filesystem::exists(folder / "frame_000000.png")) << camera;
  }
}

TEST(Run, PicturesAreNumberedAsTheFramesOfTheTable) {
  CommandScene scene;
  add_camera_out_of_step(scene);
  EXPECT_EQ(scene.berth({"run", "scene.yaml", "--picture", "pictures"}).exit_status, 0);
  const std::vector<std::string> names = scene.all_names();
  for (const char* name : {"front/frame_000000.png", "again/frame_000001.png",
                           "front/frame_000002.png", "front/frame_000003.png"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), std::string("pictures/") + name), 1) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(scene / "pictures/front/frame_000001.png"));
}

TEST(Run, AFrameThatIsNotThereIsRefused) {
  const CommandScene scene;
  const Outcome none = scene.berth({"run", "scene.yaml", "--picture", "pictures", "--frame", "3"});
  EXPECT_EQ(none.exit_status, 1);
  EXPECT_EQ(none.out, "");
  EXPECT_NE(none.err.find("--frame 3: there is no such frame; expected 0 to 2"), std::string::npos)
      << none.err;
}

TEST(Run, ImagesOfOneInstantGiveOneLine) {
  CommandScene scene;
  scene.lines.evaluation = "{range_m: 2}";
  add_second_camera(scene);
  const std::vector<Json> lines = scene.json({"run", "scene.yaml", "--picture", "pictures"});
  ASSERT_EQ(lines.size(), 3U);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(lines[k]["frame"], k);
    EXPECT_EQ(lines[k]["stamp_s"], k);
    EXPECT_EQ(lines[k]["cameras"][0]["frame"], k);
    EXPECT_EQ(lines[k]["cameras"][1]["frame"], std::min(k, 1));
  }
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/front/frame_000002.png"));
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/again/frame_000001.png"));
}

TEST(Run, WorksFromAnyFolder) {
  const CommandScene scene;
  const TemporaryFolder elsewhere;
  const Outcome outcome =
      run_berth(elsewhere / "", {"run", (scene / "scene.yaml").string(), "--format", "json"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, scene.berth({"run", "scene.yaml", "--format", "json"}).out);
}

// What a user sees of a robot that is not where it should be.

TEST(CommandImplausible, AWrongScaleIsRefusedAndNamed) {
  CommandScene scene;
  scene.lines.more_camera = "depth_scale: 0.01";
  const std::vector<std::string> told = {"scene.yaml", "camera front", "0 % lie at its surface",
                                         "expected", "depth_scale is 0.001"};
  expect_refused(scene, {"run", "scene.yaml", "--out", "result.txt"}, told);
  expect_refused(scene, {"filter", "scene.yaml", "--out", "filtered"}, told);
}

TEST(CommandImplausible, OneOfTwoCamerasIsSaidAndTheOtherAnswers) {
  CommandScene scene;
  scene.lines.more_cameras =
      "  - name: wrong\n    info: camera_info.yaml\n    pose: " + scene.lines.pose +
      "\n    depth: " + scene.lines.depth + "\n    depth_scale: 0.0001\n";
  const Outcome outcome = scene.berth({"run", "scene.yaml"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("camera wrong: the robot is not where it should be"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("depth_scale is 0.001"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("camera front: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("wrong (implausible"), std::string::npos) << outcome.out;
}

// `berth run` on a recording whose camera reads few of its pixels.

/// 31 % of its pixels have a reading.
TEST(Recording, ACameraThatReadsAThirdOfItsPixelsIsOk) {
  const auto folder = data_folder() / "recordings/lbr_med7_zed2i_small";
  if (!std::filesystem::exists(folder / "scene.yaml"))
    GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
  const Outcome outcome = run_berth(folder, {"run", "scene.yaml", "--format", "json"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  // It names the method of an older berth, and nothing else is said.
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("evaluation.method is no setting any more"), std::string::npos)
      << outcome.err;
  std::istringstream lines(outcome.out);
  int frames = 0;
  for (std::string line; std::getline(lines, line); ++frames) {
    EXPECT_EQ(Json::parse(line)["cameras"][0]["status"], "ok") << line;
  }
  EXPECT_EQ(frames, 9);
}

// `berth run` of a scene whose stamps and joints do not go together.

TEST(RunTime, AFrameThatTheJointsDoNotReachHasAStatusAndNoDistance) {
  CommandScene scene;
  scene.lines.more_camera = "stamps: [-0.5, 1, 2.25]";
  const std::vector<Json> frames = scene.json({"run", "scene.yaml", "--picture", "pictures"});
  ASSERT_EQ(frames.size(), 3U);
  for (const int i : {0, 2}) {
    EXPECT_EQ(frames[i]["time"]["status"], "extrapolated_too_far");
    EXPECT_EQ(frames[i]["stamp_s"], i == 0 ? -0.5 : 2.25);
    EXPECT_EQ(frames[i]["status"], "stale");
    EXPECT_TRUE(frames[i]["nearest"].is_null());
    EXPECT_EQ(frames[i]["links"].size(), frames[1]["links"].size());
    for (const Json& link : frames[i]["links"]) {
      EXPECT_EQ(link["status"], "stale");
      EXPECT_TRUE(link["distance_m"].is_null());
      EXPECT_TRUE(link["robot_point_base_m"].is_null());
    }
  }
  EXPECT_EQ(frames[1]["time"]["status"], "ok");
  EXPECT_EQ(link_of(frames[1], "upper")["status"], "ok");
  const Outcome table = scene.berth({"run", "scene.yaml"});
  EXPECT_NE(table.out.find("frame 0, -0.500 s"), std::string::npos);
  EXPECT_NE(table.out.find("range 2 m, no answer: extrapolated_too_far"), std::string::npos);
  EXPECT_EQ(scene.berth({"filter", "scene.yaml", "--out", "filtered"}).exit_status, 0);
}

TEST(RunTime, TheScenesLimitsDecide) {
  CommandScene scene;
  scene.lines.more_camera = "stamps: [0.3, 1, 2.25]";
  // The images do not belong to these joints.
  const std::string unwatched = "\nwatch: {min_at_robot: 0}";
  scene.lines.more = unwatched;
  const auto status = [&](int frame) { return scene.run().at(frame)["time"]["status"]; };
  EXPECT_EQ(status(0), "skewed") << "0.1 s is the default";
  scene.lines.more = "time: {max_skew_s: 0.29}" + unwatched;
  EXPECT_EQ(status(0), "skewed");
  scene.lines.more = "time: {max_skew_s: 0.31}" + unwatched;
  EXPECT_EQ(status(0), "ok");
  EXPECT_EQ(status(2), "extrapolated_too_far");
}

TEST(Demo, RunsTheBundledSceneAndDrawsIt) {
  if (!std::filesystem::exists(BERTH_SOURCE_DIR "/data/bundled/scene.yaml")) {
    GTEST_SKIP() << "data/bundled is missing";
  }
  const TemporaryFolder folder;
  const Outcome outcome = run_berth(folder / "", {"demo"});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("distance [m]"), std::string::npos);
  EXPECT_NE(outcome.out.find(" ok "), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"berth_demo"});
  EXPECT_NE(outcome.out.find((folder / "berth_demo").string()), std::string::npos);
  EXPECT_NE(outcome.out.find("The closest approach in 101 images is in frame 48, 1.713 s:"),
            std::string::npos);
  for (const char* picture :
       {"camera/frame_000000.png", "left/frame_000001.png", "camera/frame_000048.png"}) {
    EXPECT_TRUE(read_file_bytes(folder / "berth_demo" / picture).starts_with("\x89PNG\r\n"))
        << picture;
  }
}

}  // namespace
}  // namespace berth
