// The robot is not where it should be: simple mistakes in the bundled scene.
#include "berth/scene/plausibility.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>

#include "berth/pipeline/observer.hpp"
#include "berth/results/result_json.hpp"
#include "berth/scene/scene_run.hpp"
#include "lab/watch/good_scenes.hpp"
#include "lab/watch/mistakes.hpp"
#include "tests/support/coarse_arm.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

using Json = nlohmann::json;

/// Some images of each of the bundled cameras, the arm in other poses in each.
SceneFile thinned_scene(bool is_coarse = true) {
  SceneFile scene = read_scene(BERTH_SOURCE_DIR "/data/bundled/scene.yaml");
  if (is_coarse) {
    const auto& folder = testing::coarse_arm_folder(BERTH_SOURCE_DIR "/data/bundled/arm");
    scene.robot.urdf = folder / "arm.urdf";
    scene.robot.package_paths["berth_arm"] = folder;
  }
  for (SceneCamera& camera : scene.cameras) {
    std::vector<std::filesystem::path> depth;
    std::vector<double> stamps_s;
    for (std::size_t k = 0; k < camera.depth.size(); k += 9) {
      depth.push_back(camera.depth[k]);
      stamps_s.push_back(camera.stamps_s[k]);
    }
    camera.depth = depth;
    camera.stamps_s = stamps_s;
  }
  return scene;
}

class Plausibility : public ::testing::Test {
 protected:
  static const OpenScene& right() {
    static const OpenScene scene = open_scene(thinned_scene());
    return scene;
  }
};

TEST_F(Plausibility, ARightSceneIsRight) {
  for (const CameraPlausibility& camera : find_implausible(open_scene(thinned_scene(false)))) {
    EXPECT_FALSE(camera.is_implausible) << text_of(camera);
    EXPECT_FALSE(camera.is_hidden);
    EXPECT_EQ(text_of(camera), "");
    EXPECT_GT(camera.readings.at_robot(), 0.98) << camera.camera;
    EXPECT_GE(camera.frames, 4U);
  }
}

TEST_F(Plausibility, EachMistakeIsFoundAndNamed) {
  std::size_t c = 0;
  for (const lab::MadeMistake& mistake : lab::mistakes_in(right())) {
    // Slight ones move too little of this arm.
    if (mistake.cause.empty() || mistake.is_slight) continue;
    c = (c + 1) % right().cameras.size();
    OpenScene wrong = right();
    mistake.make(wrong, c);
    const CameraPlausibility found = find_implausible(wrong, c);
    EXPECT_TRUE(found.is_implausible) << mistake.name << ", camera " << found.camera;
    expect_parts(text_of(found), {"camera " + found.camera, "expected", mistake.cause});
  }
}

TEST_F(Plausibility, AGreatestNumberInPlaceOfNoReadingIsNamed) {
  OpenScene scene = right();
  OpenCamera& camera = scene.cameras[0];
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    DepthImage image_m = camera.read_depth(k);
    for (int u = 0; u < image_m.width(); ++u) {
      for (int v = 0; v < 40; ++v) image_m(u, v) = 8.191F;
    }
    camera.kept_depth_m[k] = std::make_shared<const DepthImage>(std::move(image_m));
  }
  const CameraPlausibility found = find_implausible(scene, 0);
  EXPECT_TRUE(found.is_implausible);
  expect_parts(text_of(found), {"the number 8191 stands at", "far_m below 8.191"});
}

TEST_F(Plausibility, ABlindCameraIsDeadWhereverTheRobotIs) {
  OpenScene scene = right();
  lab::move_camera(scene, 0, 30, 0, 1);
  OpenCamera& camera = scene.cameras[0];
  const Camera& size = camera.mounted->camera();
  const auto none = std::make_shared<const DepthImage>(size.width_px, size.height_px, kNoDepth);
  std::ranges::fill(camera.kept_depth_m, none);
  expect_parts(text_of(find_implausible(scene, 0)), {"no pixel of its images has a reading"});
}

TEST_F(Plausibility, LimitsThatLeaveOutAllAreNamed) {
  SceneFile file = thinned_scene();
  file.cameras[0].near_m = 40;
  const CameraPlausibility found = find_implausible(open_scene(file), 0);
  EXPECT_TRUE(found.is_implausible);
  expect_parts(text_of(found), {"near_m and far_m leave out its readings, from"});
}

TEST_F(Plausibility, WhatIsDoubtfulIsTold) {
  OpenScene off = right();
  lab::move_camera(off, 0, 0.05, 0.087, 1);
  const CameraPlausibility found = find_implausible(off, 0);
  EXPECT_FALSE(found.is_implausible);
  expect_parts(text_of(found), {"camera camera: ", "% of the readings where the robot should be",
                                "expected 85 % at least"});
}

TEST_F(Plausibility, ALinkThatIsNotThereIsTold) {
  // Such as a zone: a wall of air beside the robot.
  SceneFile file = thinned_scene();
  SceneAttachment& zone = file.attached.emplace_back();
  zone.link = "arm_link_0";
  zone.name = "zone";
  zone.box_m = Eigen::Vector3d(0.3, 0.3, 0.3);
  zone.X_LA = Pose(Eigen::Translation3d(0.5, -0.6, 0.5));
  std::size_t told = 0;
  const OpenScene scene = open_scene(file);
  for (const CameraPlausibility& camera : find_implausible(scene)) {
    const std::string text = text_of(camera);
    told += text.find("most of what is read at zone lies behind it") != std::string::npos;
  }
  EXPECT_GE(told, 2U);
}

TEST_F(Plausibility, APoseThatIsOffAndPeopleAreNoMistakes) {
  for (std::size_t c = 0; c < right().cameras.size(); ++c) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      for (const auto& [offset_m, angle_rad] : {std::pair{0.02, 0.035}, {0.05, 0.087}}) {
        OpenScene off = right();
        lab::move_camera(off, c, offset_m, angle_rad, seed);
        const CameraPlausibility found = find_implausible(off, c);
        EXPECT_FALSE(found.is_implausible) << text_of(found);
      }
      OpenScene hidden = right();
      lab::hide_robot(hidden, c, seed);
      const CameraPlausibility found = find_implausible(hidden, c);
      EXPECT_FALSE(found.is_implausible) << text_of(found);
    }
  }
}

TEST_F(Plausibility, ASimulationWhoseRobotStandsStillIsNotDead) {
  OpenScene still = right();
  OpenCamera& camera = still.cameras[0];
  const auto first_m = std::make_shared<const DepthImage>(camera.read_depth(0));
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    camera.kept_depth_m[k] = first_m;
    camera.at_exposure[k].position = camera.at_exposure[0].position;
  }
  // Much of the robot has to lie behind its surface.
  lab::move_camera(still, 0, 0.05, 0.087, 1);
  const CameraPlausibility found = find_implausible(still, 0);
  EXPECT_EQ(found.dead, "");
  EXPECT_FALSE(found.is_implausible) << text_of(found);
}

/// A wall before the camera.
void hide_all(OpenCamera& camera) {
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    DepthImage wall_m = camera.read_depth(k);
    float z_m = 0.5F;
    for (float& reading_m : wall_m.pixels()) {
      z_m = z_m > 0.6F ? 0.5F : z_m + 0.001F;
      reading_m = z_m;
    }
    camera.kept_depth_m[k] = std::make_shared<const DepthImage>(std::move(wall_m));
  }
}

TEST_F(Plausibility, AHiddenRobotIsToldAsHidden) {
  OpenScene scene = right();
  hide_all(scene.cameras[0]);
  const CameraPlausibility found = find_implausible(scene, 0);
  EXPECT_FALSE(found.is_implausible) << text_of(found);
  EXPECT_TRUE(found.is_hidden);
  expect_parts(text_of(found), {"camera camera", "hidden", "100 %"});
  SceneRun run(scene);
  ASSERT_TRUE(run.next());
  const Json line = Json::parse(result_json(run.ask()));
  EXPECT_EQ(line["cameras"][0]["status"], "hidden");
  EXPECT_EQ(line["time"]["status"], "ok");
}

/// The image with readings in a quarter of its pixels alone, those at the robot and nearest to it.
DepthImage near_robot(DepthImage depth_m, const RobotImage& robot) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  std::vector<bool> is_met(depth_m.pixels().size());
  std::vector<int> nearest_first;
  const auto meet = [&](int u, int v) {
    if (u < 0 || v < 0 || u >= width || v >= height || is_met[v * width + u]) return;
    is_met[v * width + u] = true;
    nearest_first.push_back(v * width + u);
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      if (robot.link_id(u, v) != kNoLink && robot.link_id(u, v) != kEnvironmentLink) meet(u, v);
  for (std::size_t i = 0; i < nearest_first.size(); ++i) {
    const int u = nearest_first[i] % width;
    const int v = nearest_first[i] / width;
    for (const auto& [du, dv] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) meet(u + du, v + dv);
  }
  std::size_t readings = 0;
  for (const int i : nearest_first) {
    float& reading_m = depth_m.pixels()[i];
    if (4 * readings >= nearest_first.size()) reading_m = std::numeric_limits<float>::quiet_NaN();
    readings += !std::isnan(reading_m);
  }
  return depth_m;
}

TEST_F(Plausibility, ACameraThatReadsAQuarterOfItsPixelsIsOk) {
  OpenScene scene = open_scene(thinned_scene());
  for (OpenCamera& camera : scene.cameras) {
    Observer observer(camera.mounted);
    Frame frame;
    for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
      const DepthImage depth_m = camera.read_depth(k);
      observer.observe(depth_m, camera.at_exposure[k], frame);
      camera.kept_depth_m[k] = std::make_shared<const DepthImage>(near_robot(depth_m, frame.robot));
    }
  }
  for (const CameraPlausibility& camera : find_implausible(scene)) {
    EXPECT_FALSE(camera.is_implausible) << text_of(camera);
    EXPECT_EQ(camera.dead, "");
    EXPECT_GT(camera.readings.at_robot(), 0.98) << camera.camera;
  }
  SceneRun run(scene);
  int answers = 0;
  while (run.next()) {
    const Json line = Json::parse(result_json(run.ask()));
    for (const Json& camera : line["cameras"]) {
      if (camera["frame"].is_null() || camera["status"] == "too_old") continue;
      EXPECT_EQ(camera["status"], "ok") << camera["camera"];
    }
    answers += line["time"]["status"] == "ok";
  }
  EXPECT_GT(answers, 5);
}

TEST_F(Plausibility, WhereAllCamerasAreImplausibleThereIsNoRun) {
  SceneFile file = thinned_scene();
  for (SceneCamera& camera : file.cameras) camera.depth_scale_m = 0.01;
  const OpenScene scene = open_scene(file);
  expect_parts(error_message([&] { SceneRun run(scene); }),
               {"scene.yaml: camera camera", "0 % lie at its surface", "depth_scale is 0.001",
                "camera left", "camera right"});
}

/// In which the joints of these cameras' exposures are in degrees.
OpenScene in_degrees(OpenScene scene, std::span<const std::size_t> cameras) {
  for (const std::size_t c : cameras) {
    for (JointState& state : scene.cameras[c].at_exposure) {
      for (double& position : state.position) position *= 180 / std::numbers::pi;
    }
  }
  return scene;
}

TEST_F(Plausibility, JointsInDegreesAreNoSingleCamerasMistake) {
  OpenScene scene = in_degrees(right(), std::array<std::size_t, 3>{0, 1, 2});
  // Which does not tell then.
  hide_all(scene.cameras[1]);
  EXPECT_FALSE(find_implausible(scene, 1).is_implausible);
  const std::string message = error_message([&] { SceneRun run(scene); });
  expect_parts(message, {"scene.yaml: camera camera", "the joints are in degrees"});
  EXPECT_EQ(message.find("camera left"), std::string::npos) << message;
}

TEST_F(Plausibility, ACameraThatFitsContradictsAMistakeInTheJoints) {
  const OpenScene scene = in_degrees(right(), std::array<std::size_t, 1>{2});
  const std::vector<CameraPlausibility> cameras = find_implausible(scene);
  EXPECT_EQ(cameras[2].cause, "the joints are in degrees");
  EXPECT_TRUE(cameras[2].in_joints.empty());
  const SceneRun run(scene);
  EXPECT_TRUE(run.plausibility()[2].is_implausible);
}

TEST_F(Plausibility, TheOtherCamerasAnswerStands) {
  SceneFile file = thinned_scene();
  file.cameras[1].depth_scale_m = 0.0001;
  const OpenScene scene = open_scene(file);
  SceneRun run(scene);
  EXPECT_TRUE(run.plausibility()[1].is_implausible);
  int answers = 0;
  while (run.next()) {
    const Json line = Json::parse(result_json(run.ask()));
    for (const Json& camera : line["cameras"]) {
      if (camera["frame"].is_null() || camera["status"] == "too_old") continue;
      const bool is_left = camera["camera"] == "left";
      EXPECT_EQ(camera["status"], is_left ? "implausible" : "ok");
      const Json& at_robot = camera["at_robot"];
      // Null where its images do not tell.
      EXPECT_NE(at_robot.is_number() && at_robot > 0.5, is_left);
    }
    EXPECT_NE(line["time"]["status"], "camera_implausible");
    for (const Json& link : line["links"]) {
      EXPECT_NE(link["status"], "stale");
      EXPECT_NE(link["camera"], "left");
    }
    answers += line["time"]["status"] == "ok";
  }
  EXPECT_GT(answers, 5);
}

TEST_F(Plausibility, WithTheLimitAtZeroNobodyLooks) {
  SceneFile file = thinned_scene();
  for (SceneCamera& camera : file.cameras) {
    camera.depth_scale_m = 0.01;
    camera.settings.watch.min_at_robot = 0;
  }
  const OpenScene scene = open_scene(file);
  SceneRun run(scene);
  ASSERT_TRUE(run.next());
  const Json line = Json::parse(result_json(run.ask()));
  EXPECT_EQ(line["cameras"][0]["status"], "ok");
}

TEST_F(Plausibility, AHigherLimitRefusesAPoseThatIsOff) {
  SceneFile file = thinned_scene();
  for (SceneCamera& camera : file.cameras) camera.settings.watch.min_at_robot = 0.9;
  OpenScene scene = open_scene(file);
  EXPECT_FALSE(find_implausible(scene, 0).is_implausible);
  lab::move_camera(scene, 0, 0.05, 0.087, 1);
  const CameraPlausibility found = find_implausible(scene, 0);
  EXPECT_TRUE(found.is_implausible);
  expect_parts(text_of(found), {"None of the mistakes that berth tries"});
}

TEST_F(Plausibility, ReadingsOutsideOfTheCamerasLimitsAreLookedAt) {
  SceneFile file = thinned_scene();
  file.cameras[0].depth_scale_m = 0.01;
  file.cameras[0].far_m = 4;
  const CameraPlausibility found = find_implausible(open_scene(file), 0);
  EXPECT_TRUE(found.is_implausible);
  EXPECT_EQ(found.cause, "depth_scale is 0.001, not 0.01");
}

}  // namespace
}  // namespace berth
