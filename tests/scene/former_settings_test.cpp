#include "berth/scene/former_settings.hpp"

#include <gtest/gtest.h>

#include "berth/scene/scene_file.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

SceneFile scene_with(const std::string& settings) {
  return parse_scene("scene.yaml",
                     "robot: {urdf: r.urdf}\n"
                     "cameras:\n"
                     "  - {name: c, info: i.yaml, pose: {parent: b, xyz: [0, 0, 0], rpy: [0, 0, "
                     "0]}, depth: [d.png]}\n"
                     "joints: j.csv\n" +
                         settings);
}

TEST(FormerSettings, AreReadAndToldWithTheirNewName) {
  const SceneFile scene = scene_with(
      "space: {slab_m: 0.05}\nself_filter: {island_radius_m: 0.01}\nseparation: {hidden: stop, "
      "intrusion_m: 0.2}\n");
  const CameraSettings& camera = scene.cameras.front().settings;
  EXPECT_EQ(camera.space.surface_thickness_m, 0.05);
  EXPECT_EQ(camera.self_filter.flying_patch_radius_m, 0.01);
  EXPECT_EQ(scene.separation->unknown, UnknownPolicy::stop);
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{"scene.yaml:5: slab_m is called surface_thickness_m now; the "
                                      "former name is read for one version more",
                                      "scene.yaml:6: island_radius_m is called "
                                      "flying_patch_radius_m now; the former name is read for one "
                                      "version more",
                                      "scene.yaml:7: hidden is called unknown now; the former name "
                                      "is read for one version more"}));
}

TEST(FormerSettings, ThoseThatEndedAreToldAndHaveNoEffect) {
  const SceneFile scene = scene_with(
      "separation: {hold_s: 0.3, release_m: 0.05, directed_speed: true, intrusion_m: 0.2}\n");
  EXPECT_EQ(scene.warnings,
            (std::vector<std::string>{
                "scene.yaml:5: hold_s is no setting any more, and has no effect",
                "scene.yaml:5: release_m is no setting any more, and has no effect",
                "scene.yaml:5: directed_speed is no setting any more, and has no effect"}));
}

TEST(FormerSettings, HolesThatWereObstaclesAreRefusedWithWhatToDoInstead) {
  EXPECT_EQ(
      scene_with("sensor: {holes: free}\n").warnings,
      std::vector<std::string>{"scene.yaml:5: holes is no setting any more, and has no effect"});
  const std::string message = error_message([] { scene_with("sensor: {holes: obstacle}\n"); });
  EXPECT_NE(message.find("scene.yaml:5: sensor.holes: obstacle; expected space.no_reading: hides"),
            std::string::npos)
      << message;
}

TEST(FormerSettings, NewNamesGiveNoWarning) {
  EXPECT_TRUE(scene_with("space: {surface_thickness_m: 0.05}\n").warnings.empty());
}

TEST(FormerSettings, BothNamesAreRefused) {
  EXPECT_EQ(error_message([] { scene_with("space: {slab_m: 0.05, surface_thickness_m: 0.05}\n"); }),
            "scene.yaml:5: space.slab_m: slab_m; expected surface_thickness_m alone, its name now");
}

}  // namespace
}  // namespace berth
