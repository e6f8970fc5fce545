// `berth filter` writes three images, and `berth evaluate` gives from them what `run` gives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "berth/files/file_bytes.hpp"
#include "berth/files/png.hpp"
#include "tests/apps/command_scene.hpp"

namespace berth {
namespace {

/// From half a unit of the depth images, along and across the ray.
constexpr double kRounding_m = 1e-3;

/// A scene whose images of three frames lie in filtered/.
class Evaluate : public ::testing::Test {
 protected:
  Evaluate() {
    const Outcome outcome = scene.berth({"filter", "scene.yaml", "--out", "filtered"});
    EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
  }

  static std::vector<std::string> command(int frame) {
    const auto file = [&](const char* name) {
      return fmt::format("filtered/{}_{:06}.png", name, frame);
    };
    return {"evaluate",       "--camera",          "camera_info.yaml",
            "--robot-depth",  file("robot_depth"), "--link-ids",
            file("link_ids"), "--obstacle-depth",  file("obstacle_depth")};
  }
  Json evaluate(int frame, const std::vector<std::string>& more = {"--range", "2"}) const {
    std::vector<std::string> arguments = command(frame);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return scene.json(arguments).at(0);
  }

  CommandScene scene;
};

/// Depth-space distance of each link, pair by pair as depth-space.md has it (Hirt 2.10 to 2.14).
std::vector<double> distances_by_hand(const CommandScene& scene, int link_count) {
  const Camera camera = scene_camera();
  const auto depth = [&](const char* name) {
    return read_depth_png(scene / fmt::format("filtered/{}_000001.png", name), camera, 0.001);
  };
  const DepthImage robot_m = depth("robot_depth"), obstacle_m = depth("obstacle_depth");
  const Image<LinkId> ids = read_link_ids_png(scene / "filtered/link_ids_000001.png", camera);
  const double cx = camera.corner_cx_px(), cy = camera.corner_cy_px();
  std::vector<double> least(link_count, INFINITY);
  for (int rv = 0; rv < 48; ++rv) {
    for (int ru = 0; ru < 64; ++ru) {
      if (ids(ru, rv) == kNoLink) continue;
      for (int ov = 0; ov < 48; ++ov) {
        for (int ou = 0; ou < 64; ++ou) {
          if (std::isnan(obstacle_m(ou, ov))) continue;
          const double dR = robot_m(ru, rv), d = std::max<double>(dR, obstacle_m(ou, ov));
          const double x = ((ru > ou ? ou + 1 : ou) - cx) * d - ((ru < ou ? ru + 1 : ru) - cx) * dR;
          const double y = ((rv > ov ? ov + 1 : ov) - cy) * d - ((rv < ov ? rv + 1 : rv) - cy) * dR;
          const double distance_m = std::hypot(x / camera.fx_px, y / camera.fy_px, d - dR);
          least[ids(ru, rv) - 1] = std::min(least[ids(ru, rv) - 1], distance_m);
        }
      }
    }
  }
  return least;
}

TEST_F(Evaluate, GivesTheLeastDistanceOfAllPairsOfTheImages) {
  const Json frame = evaluate(1);
  const std::vector<double> expected = distances_by_hand(scene, frame["links"].size());
  int seen = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Json& link = frame["links"][i];
    if (std::isinf(expected[i])) {
      EXPECT_EQ(link["status"], "not_visible");
      continue;
    }
    ++seen;
    EXPECT_NEAR(link["distance_m"].get<double>(), expected[i], 1e-5) << link;
  }
  EXPECT_EQ(seen, 4);
}

TEST_F(Evaluate, OfThreeImagesAgreesWithOfTheSceneToTheImagesRounding) {
  const std::vector<Json> run = scene.json({"evaluate", "scene.yaml"});
  for (int i = 0; i < 3; ++i) {
    const Json frame = evaluate(i);
    for (const Json& link : frame["links"]) {
      const Json& expected = run[i]["links"].at(link["id"].get<int>() - 1);
      EXPECT_EQ(link["status"], expected["status"]);
      EXPECT_EQ(link["robot_pixels"], expected["robot_pixels"]);
      if (link["status"] != "ok") continue;
      EXPECT_NEAR(link["distance_m"].get<double>(), expected["distance_m"].get<double>(),
                  kRounding_m);
    }
  }
}

TEST_F(Evaluate, NamesLinksByIdAndHasNoPointsInTheBase) {
  const Json frame = evaluate(0, {});
  EXPECT_EQ(frame["schema"], "berth/result/3");
  EXPECT_EQ(frame["method"], "exact");
  EXPECT_EQ(frame["range_m"], 1);
  EXPECT_FALSE(frame.contains("timing"));
  ASSERT_FALSE(frame["links"].empty());
  for (const Json& link : frame["links"]) {
    EXPECT_EQ(link["link"], fmt::format("link_{}", link["id"].get<int>()));
    EXPECT_TRUE(link["robot_point_base_m"].is_null());
    EXPECT_TRUE(link["obstacle_point_base_m"].is_null());
    EXPECT_EQ(link["robot_point_camera_m"].is_array(), link["status"] == "ok");
    EXPECT_EQ(link["obstacle_point_camera_m"].is_array(), link["status"] == "ok");
  }
}

TEST_F(Evaluate, RepeatTellsTheTimesAndChangesNoResult) {
  Json timed = evaluate(0, {"--range", "2", "--repeat", "7", "--threads", "1"});
  const Json timing = timed["timing"];
  EXPECT_EQ(timing["repeat"], 7);
  const Json us = timing["evaluate_us"];
  EXPECT_GT(us["min"], 0);
  EXPECT_LE(us["min"], us["p50"]);
  EXPECT_LE(us["p50"], us["p99"]);
  EXPECT_LE(us["p99"], us["max"]);
  timed.erase("timing");
  Json once = evaluate(0);
  timed.erase("pairs");
  once.erase("pairs");
  EXPECT_EQ(timed, once);
}

TEST_F(Evaluate, AToleranceOrADeadlineLeavesALowerBound) {
  const Json exact = evaluate(2);
  for (const std::vector<std::string>& limit :
       {std::vector<std::string>{"--tolerance-m", "0.05"},
        {"--deadline-us", "0"},
        {"--deadline-us", "1000000", "--tolerance-m", "0"}}) {
    std::vector<std::string> more = {"--range", "2"};
    more.insert(more.end(), limit.begin(), limit.end());
    const Json limited = evaluate(2, more);
    for (std::size_t i = 0; i < exact["links"].size(); ++i) {
      const Json& link = limited["links"][i];
      if (exact["links"][i]["status"] != "ok") continue;
      EXPECT_EQ(exact["links"][i]["lower_bound_m"], exact["links"][i]["distance_m"]);
      ASSERT_TRUE(link["lower_bound_m"].is_number());
      EXPECT_LE(link["lower_bound_m"], exact["links"][i]["distance_m"]);
      EXPECT_GE(link["distance_m"], exact["links"][i]["distance_m"]);
    }
  }
}

TEST_F(Evaluate, LimitsAreRefusedForAMethodThatHasNone) {
  for (const std::string limit : {"--tolerance-m", "--deadline-us"}) {
    std::vector<std::string> arguments = command(0);
    arguments.insert(arguments.end(), {"--method", "brute_force", limit, "1"});
    const Outcome outcome = scene.berth(arguments);
    EXPECT_EQ(outcome.exit_status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("brute_force"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(limit), std::string::npos) << outcome.err;
  }
}

TEST_F(Evaluate, MeanDirectionCanBeTurnedOff) {
  const Json on = evaluate(0);
  const Json off = evaluate(0, {"--range", "2", "--mean-direction", "off"});
  int directions = 0;
  for (const Json& link : on["links"]) {
    directions += link["mean_count"] > 0;
    EXPECT_TRUE(link["mean_direction_base"].is_null()) << "three images have no base frame";
  }
  EXPECT_GT(directions, 0);
  for (const Json& link : off["links"]) EXPECT_EQ(link["mean_count"], 0);
}

TEST_F(Evaluate, RobotDepthWithoutLinkIdBelongsToNoLink) {
  const Json before = evaluate(0);
  const std::string file = "filtered/robot_depth_000000.png";
  DepthImage robot_m = read_depth_png(scene / file, scene_camera(), 0.001);
  ASSERT_TRUE(std::isnan(robot_m(50, 15)));
  robot_m(50, 15) = 1.7F;
  write_depth_png(scene / file, robot_m, 0.001);
  EXPECT_EQ(evaluate(0)["links"], before["links"]);
}

TEST_F(Evaluate, TwiceTheDepthScaleIsTwiceTheDistance) {
  const Json once = evaluate(0, {"--range", "2"});
  const Json twice = evaluate(0, {"--range", "4", "--depth-scale", "0.002"});
  for (std::size_t i = 0; i < once["links"].size(); ++i) {
    if (once["links"][i]["status"] != "ok") continue;
    EXPECT_NEAR(twice["links"][i]["distance_m"].get<double>(),
                2 * once["links"][i]["distance_m"].get<double>(), 1e-5);
  }
}

TEST_F(Evaluate, PrintsATableOrWritesAFile) {
  std::vector<std::string> arguments = command(0);
  const Outcome table = scene.berth(arguments);
  EXPECT_EQ(table.exit_status, 0) << table.err;
  EXPECT_NE(table.out.find("distance [m]"), std::string::npos);
  EXPECT_NE(table.out.find("link_1"), std::string::npos);
  arguments.insert(arguments.end(), {"--out", "table.txt"});
  const Outcome written = scene.berth(arguments);
  EXPECT_EQ(written.exit_status, 0) << written.err;
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read_file_bytes(scene / "table.txt"), table.out);
}

TEST_F(Evaluate, ImageWithoutRobotHasNoLinks) {
  write_link_ids_png(scene / "none.png", Image<LinkId>(64, 48, kNoLink));
  std::vector<std::string> arguments = command(0);
  arguments[6] = "none.png";
  EXPECT_EQ(scene.json(arguments).at(0)["links"], Json::array());
}

TEST(Filter, WritesThreeImagesForEachFrameAndNothingElse) {
  const CommandScene scene;
  std::vector<std::string> names = scene.all_names();
  EXPECT_EQ(scene.berth({"filter", "scene.yaml", "--out", "a/b", "--threads", "1"}).exit_status, 0);
  names.insert(names.end(), {"a", "a/b"});
  for (const char* name : {"robot_depth", "link_ids", "obstacle_depth"}) {
    for (int i = 0; i < 3; ++i) names.push_back(fmt::format("a/b/{}_{:06}.png", name, i));
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(scene.all_names(), names);
}

TEST(Filter, ImagesShowTheRobotItsLinksAndTheObstacles) {
  const CommandScene scene;
  const Json frame = scene.json({"evaluate", "scene.yaml"}).at(0);
  ASSERT_EQ(scene.berth({"filter", "scene.yaml", "--out", "f"}).exit_status, 0);
  const Camera camera = scene_camera();
  const DepthImage robot_m = read_depth_png(scene / "f/robot_depth_000000.png", camera, 0.001);
  const Image<LinkId> ids = read_link_ids_png(scene / "f/link_ids_000000.png", camera);
  const DepthImage obstacle_m =
      read_depth_png(scene / "f/obstacle_depth_000000.png", camera, 0.001);
  std::vector<int> pixels(frame["links"].size() + 1, 0);
  int obstacles = 0;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      ASSERT_LT(ids(u, v), pixels.size());
      ++pixels[ids(u, v)];
      EXPECT_EQ(std::isnan(robot_m(u, v)), ids(u, v) == kNoLink);
      obstacles += std::isnan(obstacle_m(u, v)) ? 0 : 1;
    }
  }
  for (const Json& link : frame["links"]) {
    EXPECT_EQ(pixels[link["id"].get<int>()], link["robot_pixels"]) << link["link"];
  }
  EXPECT_EQ(obstacles, frame["cameras"][0]["self_filter"]["obstacle"]);
  EXPECT_EQ(obstacle_m(50, 15), 1.7F);
  EXPECT_EQ(obstacle_m(0, 0), 3.0F);
}

TEST(Filter, DepthIsInUnitsOfTheCamera) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_camera = "depth_scale: 0.0005\n    stamps: [0]";
  scene.write_image("depth/000000.png", kPositions[0], front_pose(), 0.0005);
  ASSERT_EQ(scene.berth({"filter", "scene.yaml", "--out", "f"}).exit_status, 0);
  const DepthImage obstacle_m =
      read_depth_png(scene / "f/obstacle_depth_000000.png", scene_camera(), 0.0005);
  EXPECT_NEAR(obstacle_m(0, 0), 3, 1e-6);
}

TEST(Filter, SeveralCamerasHaveAFolderEach) {
  CommandScene scene;
  scene.lines.depth = "[depth/000000.png]";
  scene.lines.more_camera = "stamps: [0]";
  scene.lines.more_cameras =
      "  - {name: again, info: camera_info.yaml, depth: [depth/000000.png, depth/000001.png], "
      "stamps: [0, 1], pose: " +
      scene.lines.pose + "}\n";
  ASSERT_EQ(scene.berth({"filter", "scene.yaml", "--out", "f"}).exit_status, 0);
  EXPECT_EQ(read_file_bytes(scene / "f/front/link_ids_000000.png"),
            read_file_bytes(scene / "f/again/link_ids_000000.png"));
  EXPECT_TRUE(std::filesystem::exists(scene / "f/again/robot_depth_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(scene / "f/front/robot_depth_000001.png"));
  EXPECT_FALSE(std::filesystem::exists(scene / "f/robot_depth_000000.png"));
}

}  // namespace
}  // namespace berth
