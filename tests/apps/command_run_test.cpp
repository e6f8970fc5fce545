// `berth run`: what it prints and writes.
#include <gtest/gtest.h>

#include <set>

#include "berth/files/file_bytes.hpp"
#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

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
  // Per frame a title, the table's header, five links and an empty line.
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 3 * 8);
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

TEST(Run, OnePictureOfEachCameraIsDrawnOnRequest) {
  CommandScene scene;
  add_second_camera(scene);
  const std::vector<Json> lines =
      scene.json({"run", "scene.yaml", "--picture", "pictures", "--frame", "1"});
  EXPECT_EQ(lines.size(), 3U);
  EXPECT_FALSE(std::filesystem::exists(scene / "pictures/front/frame_000000.png"));
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/front/frame_000001.png"));
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/again/frame_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(scene / "pictures/front/frame_000002.png"));
  const Outcome none = scene.berth({"run", "scene.yaml", "--picture", "pictures", "--frame", "3"});
  EXPECT_EQ(none.exit_status, 1);
  EXPECT_EQ(none.out, "");
  EXPECT_NE(none.err.find("--frame 3: there is no such image; expected 0 to 2"), std::string::npos)
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

}  // namespace
}  // namespace berth
