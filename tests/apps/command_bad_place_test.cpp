// Places that cannot be read or written to: refused before any work is done.
#include <gtest/gtest.h>

#include "tests/apps/refusal.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

TEST(BadPlace, SceneThatIsMissingOrAFolder) {
  const CommandScene scene;
  expect_refused(scene, {"run", "none.yaml"}, {"none.yaml", "No such file", "expected"});
  expect_refused(scene, {"run", "depth"}, {"depth: is a folder; expected a file"});
  expect_refused(scene, {"filter", "none.yaml", "--out", "filtered"}, {"none.yaml", "expected"});
}

TEST(BadPlace, FolderForImagesIsAFile) {
  const CommandScene scene;
  scene.write("taken", "");
  const std::vector<std::string> told = {"taken", "expected a folder"};
  expect_refused(scene, {"filter", "scene.yaml", "--out", "taken"}, told);
  expect_refused(scene, {"filter", "scene.yaml", "--out", "taken/below"}, told);
  expect_refused(scene, {"run", "scene.yaml", "--picture", "taken"}, told);
}

TEST(BadPlace, FolderOfTheLastCameraIsAFile) {
  CommandScene scene;
  scene.lines.more_cameras =
      "  - {name: again, info: camera_info.yaml, depth: [depth/000000.png], stamps: [0], pose: " +
      scene.lines.pose + "}\n";
  fs::create_directories(scene / "f/front");
  scene.write("f/again", "");
  expect_refused(scene, {"filter", "scene.yaml", "--out", "f"}, {"f/again", "expected a folder"});
  expect_refused(scene, {"run", "scene.yaml", "--picture", "f"}, {"f/again", "expected a folder"});
}

TEST(BadPlace, ResultFileCannotBeMade) {
  const CommandScene scene;
  expect_refused(scene, {"run", "scene.yaml", "--picture", "p", "--out", "none/result.txt"},
                 {"none/result.txt", "expected"});
  expect_refused(scene, {"run", "scene.yaml", "--picture", "p", "--out", "depth"},
                 {"depth", "expected"});
}

}  // namespace
}  // namespace berth
