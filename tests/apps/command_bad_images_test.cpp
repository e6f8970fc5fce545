// `berth evaluate` refuses images that do not fit together.
#include <gtest/gtest.h>

#include "berth/files/png.hpp"
#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

class BadImages : public ::testing::Test {
 protected:
  BadImages() { EXPECT_EQ(scene.berth({"filter", "scene.yaml", "--out", "f"}).exit_status, 0); }

  void expect_refusal(const std::vector<std::string>& told) const {
    expect_refused(scene,
                   {"evaluate", "--camera", "camera_info.yaml", "--robot-depth",
                    "f/robot_depth_000000.png", "--link-ids", "f/link_ids_000000.png",
                    "--obstacle-depth", "f/obstacle_depth_000000.png", "--out", "result.txt"},
                   told);
  }

  CommandScene scene;
};

TEST_F(BadImages, LinkIdWithoutDepth) {
  Image<LinkId> ids = read_link_ids_png(scene / "f/link_ids_000000.png", scene_camera());
  ASSERT_EQ(ids(3, 2), kNoLink);
  ids(3, 2) = 1;
  write_link_ids_png(scene / "f/link_ids_000000.png", ids);
  expect_refusal(
      {"f/link_ids_000000.png: pixel (3, 2): link ID 1 where f/robot_depth_000000.png has "
       "no depth; expected a depth"});
}

TEST_F(BadImages, LinkIdThatNoLinkHas) {
  Image<LinkId> ids = read_link_ids_png(scene / "f/link_ids_000000.png", scene_camera());
  ids(5, 4) = 65535;
  write_link_ids_png(scene / "f/link_ids_000000.png", ids);
  expect_refusal({"f/link_ids_000000.png: pixel (5, 4): link ID 65535; expected 0 to 65534"});
}

TEST_F(BadImages, EachOfThemMissing) {
  for (const std::string file : {"camera_info.yaml", "f/robot_depth_000000.png",
                                 "f/link_ids_000000.png", "f/obstacle_depth_000000.png"}) {
    fs::rename(scene / file, scene / "aside");
    expect_refusal({file, "No such file", "expected"});
    fs::rename(scene / "aside", scene / file);
  }
}

TEST_F(BadImages, ResultFileCannotBeMade) {
  expect_refused(scene,
                 {"evaluate", "--camera", "camera_info.yaml", "--robot-depth",
                  "f/robot_depth_000000.png", "--link-ids", "f/link_ids_000000.png",
                  "--obstacle-depth", "f/obstacle_depth_000000.png", "--out", "none/result.txt"},
                 {"none/result.txt", "expected"});
}

}  // namespace
}  // namespace berth
