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
              (std::set<std::string>{"schema", "frame", "stamp_s", "camera", "method", "range_m",
                                     "cameras", "links", "pairs", "self_filter", "time"}));
    EXPECT_EQ(keys_of(frame["time"]),
              (std::set<std::string>{"status", "frame_age_s", "joints_age_s", "skew_s"}));
    EXPECT_EQ(frame["time"]["status"], "ok");
    EXPECT_EQ(frame["time"]["skew_s"], 0);
    EXPECT_TRUE(frame["time"]["frame_age_s"].is_null());
    EXPECT_EQ(frame["schema"], "berth/result/2");
    EXPECT_EQ(frame["frame"], i);
    EXPECT_EQ(frame["stamp_s"], i);
    EXPECT_EQ(frame["camera"], "front");
    EXPECT_EQ(frame["method"], "exact");
    EXPECT_EQ(frame["range_m"], 2);
    EXPECT_GT(frame["pairs"].get<int>(), 0);
    for (const Json& link : frame["links"]) {
      EXPECT_EQ(keys_of(link), (std::set<std::string>{
                                   "id", "link", "status", "distance_m", "robot_pixel",
                                   "obstacle_pixel", "robot_point_m", "obstacle_point_m",
                                   "robot_point_base_m", "obstacle_point_base_m", "mean_direction",
                                   "mean_count", "robot_pixels", "visibility"}));
    }
  }
}

TEST(Run, LinksAreThoseWithGeometryExceptSceneryNumberedFromOne) {
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

TEST(Run, EveryPixelHasOneFateAndSceneryIsRemoved) {
  CommandScene scene;
  // Nothing hides the robot.
  scene.surroundings.rectangles.clear();
  scene.write_images();
  for (const Json& frame : scene.run()) {
    const Json& count = frame["self_filter"];
    int sum = 0, robot_pixels = 0;
    for (const auto& [fate, pixels] : count.items()) sum += pixels.get<int>();
    for (const Json& link : frame["links"]) robot_pixels += link["robot_pixels"].get<int>();
    EXPECT_EQ(sum, 64 * 48);
    EXPECT_EQ(count["robot"], robot_pixels);
    EXPECT_GT(count["environment"], 100);
    EXPECT_EQ(count["no_reading"], 0);
    EXPECT_EQ(count["padding"].get<int>() + count["dilation"].get<int>() +
                  count["edge"].get<int>() + count["island"].get<int>() +
                  count["outside_region"].get<int>(),
              0);
  }
}

TEST(Run, DistanceIsThatOfItsTwoPointsInBothFrames) {
  const Pose X_BC = front_pose();
  for (const Json& frame : CommandScene().run()) {
    for (const std::string name : {"base", "upper", "lower", "finger"}) {
      const Json link = link_of(frame, name);
      ASSERT_EQ(link["status"], "ok") << name;
      const Eigen::Vector3d robot_C = vector_of(link["robot_point_m"]);
      const Eigen::Vector3d obstacle_C = vector_of(link["obstacle_point_m"]);
      const double distance_m = link["distance_m"];
      EXPECT_NEAR((obstacle_C - robot_C).norm(), distance_m, 1e-5);
      EXPECT_LT((X_BC * robot_C - vector_of(link["robot_point_base_m"])).norm(), 1e-5);
      EXPECT_LT((X_BC * obstacle_C - vector_of(link["obstacle_point_base_m"])).norm(), 1e-5);
    }
  }
}

TEST(Run, LinkThatIsHiddenHasNullsAndNoPixels) {
  const Json link = link_of(CommandScene().run().at(0), "plug");
  EXPECT_EQ(link["status"], "not_visible");
  EXPECT_EQ(link["robot_pixels"], 0);
  EXPECT_EQ(link["mean_count"], 0);
  for (const char* key :
       {"distance_m", "robot_pixel", "obstacle_pixel", "robot_point_m", "obstacle_point_m",
        "robot_point_base_m", "obstacle_point_base_m", "mean_direction"}) {
    EXPECT_TRUE(link[key].is_null()) << key;
  }
}

TEST(Run, LinkWithNothingWithinTheRangeHasNullsAndItsPixels) {
  const CommandScene scene;
  const Json far = link_of(scene.run().at(0), "upper");
  EXPECT_GT(far["distance_m"], 0.2);
  const Json frame = scene.json({"run", "scene.yaml", "--range", "0.2"}).at(0);
  EXPECT_EQ(frame["range_m"], 0.2);
  const Json link = link_of(frame, "upper");
  EXPECT_EQ(link["status"], "none_in_range");
  EXPECT_EQ(link["robot_pixels"], far["robot_pixels"]);
  EXPECT_GT(link["robot_pixels"], 10);
  for (const char* key :
       {"distance_m", "robot_pixel", "obstacle_pixel", "robot_point_m", "obstacle_point_m",
        "robot_point_base_m", "obstacle_point_base_m", "mean_direction"}) {
    EXPECT_TRUE(link[key].is_null()) << key;
  }
}

TEST(Run, BruteForceGivesTheSameDistances) {
  const CommandScene scene;
  const std::vector<Json> exact = scene.run();
  const std::vector<Json> slow = scene.json({"run", "scene.yaml", "--method", "brute_force"});
  ASSERT_EQ(slow.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_EQ(slow[i]["method"], "brute_force");
    EXPECT_GT(slow[i]["pairs"], exact[i]["pairs"]);
    for (const char* name : {"base", "upper", "lower", "finger"}) {
      EXPECT_NEAR(link_of(slow[i], name)["distance_m"].get<double>(),
                  link_of(exact[i], name)["distance_m"].get<double>(), 1e-6);
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

TEST(Run, MeanDirectionOffLeavesItOut) {
  const CommandScene scene;
  const Json on =
      link_of(scene.json({"run", "scene.yaml", "--mean-direction", "on"}).at(0), "base");
  const Json off =
      link_of(scene.json({"run", "scene.yaml", "--mean-direction", "off"}).at(0), "base");
  EXPECT_GT(on["mean_count"], 100);
  EXPECT_LE(vector_of(on["mean_direction"]).norm(), 1 + 1e-6);
  EXPECT_EQ(off["mean_count"], 0);
  EXPECT_TRUE(off["mean_direction"].is_null());
  EXPECT_EQ(off["distance_m"], on["distance_m"]);
}

TEST(Run, TableHasALineForEachLinkOfEachFrame) {
  const CommandScene scene;
  const Outcome outcome = scene.berth({"run", "scene.yaml"});
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const std::string word :
       {"frame 0", "frame 1", "frame 2", "camera front", "method exact", "range 2 m",
        "distance [m]", "base", "upper", "lower", "finger", "plug", "not_visible"}) {
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

TEST(Run, SeveralCamerasGiveAllTheirFramesAndAFolderOfPicturesEach) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_cameras =
      "  - {name: again, info: camera_info.yaml, depth: [depth/000000.png, depth/000001.png], "
      "pose: " +
      scene.lines.pose + "}\n";
  const std::vector<Json> frames = scene.json({"run", "scene.yaml", "--picture", "pictures"});
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0]["camera"], "front");
  EXPECT_EQ(frames[1]["camera"], "again");
  EXPECT_EQ(frames[2]["camera"], "again");
  EXPECT_EQ(frames[2]["frame"], 1);
  EXPECT_EQ(frames[0]["links"], frames[1]["links"]);
  EXPECT_TRUE(std::filesystem::exists(scene / "pictures/front/frame_000000.png"));
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
