#include "apps/view/changed_scene.hpp"

#include <gtest/gtest.h>

#include "berth/files/file_bytes.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/types/pose.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

/// The bundled scene in a folder of its own.
class ChangedSceneTest : public ::testing::Test {
 protected:
  double padding_m(std::size_t camera) const {
    return scene_.now().cameras[camera].settings.self_filter.padding_m;
  }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "scene.yaml";
  /// One camera has its own padding.
  ChangedScene scene_ = [this] {
    fs::copy(BERTH_SOURCE_DIR "/data/bundled", folder_.path(), fs::copy_options::recursive);
    std::string text = read_file_bytes(file_);
    const std::string place = "    info: camera_info_left.yaml\n";
    text.insert(text.find(place), "    self_filter: {padding_m: 0.03}\n");
    folder_.write("scene.yaml", text);
    return ChangedScene(file_);
  }();
};

TEST_F(ChangedSceneTest, SetsOneCameraAndAll) {
  scene_.set("self_filter", "padding_m", 0, "0.05");
  EXPECT_EQ(padding_m(0), 0.05);
  EXPECT_EQ(padding_m(1), 0.03);
  scene_.set("self_filter", "padding_m", std::nullopt, "0.01");
  // The camera that has its own, too.
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(padding_m(c), 0.01) << c;
  scene_.set("self_filter", "padding_m", std::nullopt, std::nullopt);
  EXPECT_EQ(padding_m(0), 0.02);
  EXPECT_EQ(padding_m(1), 0.03);
  EXPECT_TRUE(scene_.change().values.empty());
}

TEST_F(ChangedSceneTest, SetsNamesAndRequests) {
  scene_.set("space", "no_reading", 2, "hides");
  EXPECT_EQ(scene_.now().cameras[2].settings.space.no_reading, NoReading::hides);
  scene_.set("evaluation", "range_m", 1, "0.5");
  EXPECT_EQ(scene_.now().evaluation.distance.range_m, 0.5);
  scene_.set("evaluation", "visibility", std::nullopt, "false");
  EXPECT_FALSE(scene_.now().evaluation.visibility);
  scene_.reset();
  EXPECT_EQ(scene_.now().evaluation.distance.range_m, 1);
}

TEST_F(ChangedSceneTest, RefusesWhatAFileMayNotSayAndStaysAsItWas) {
  scene_.set("evaluation", "range_m", std::nullopt, "0.5");
  const auto refused = [&](const char* group, const char* key, const char* value) {
    return error_message([&] { scene_.set(group, key, std::nullopt, value); });
  };
  const std::string text = refused("self_filter", "padding_m", "-1");
  expect_parts(text, {"padding_m", "-1", "expected"});
  EXPECT_EQ(text.find(".yaml"), std::string::npos) << "the file has no such line: " << text;
  expect_parts(refused("evaluation", "range_m", "1000"), {"range_m", "1000", "up to 50"});
  expect_parts(refused("self_filter", "paddding_m", "1"), {"paddding_m"});
  EXPECT_EQ(scene_.now().evaluation.distance.range_m, 0.5);
  EXPECT_EQ(scene_.change().values.size(), 1u);
}

TEST_F(ChangedSceneTest, MovesACamera) {
  const Pose X_PC = Eigen::Translation3d(1, 2, 3) * rotation_of_rpy({0.1, 0.2, 0.3});
  scene_.set_pose(2, X_PC);
  EXPECT_TRUE(scene_.now().cameras[2].X_PC.isApprox(X_PC, 1e-8));
  scene_.set_pose(2, std::nullopt);
  EXPECT_TRUE(scene_.now().cameras[2].X_PC.isApprox(scene_.original().cameras[2].X_PC, 0));
}

TEST_F(ChangedSceneTest, TakesWhatACalibrationFound) {
  SceneChange found;
  found.cameras.emplace_back().camera = "right";
  found.cameras.back().clock_offset_s = 0.01;
  found.cameras.back().maps = {{"self_filter", {{"tolerance_m", 0.07}}}};
  scene_.add(found);
  EXPECT_EQ(scene_.now().cameras[2].clock_offset_s, 0.01);
  EXPECT_EQ(scene_.now().cameras[2].settings.self_filter.tolerance_m, 0.07);
  EXPECT_EQ(scene_.now().cameras[0].settings.self_filter.tolerance_m, 0.05);
}

TEST_F(ChangedSceneTest, SavesANewFileThatIsTheScene) {
  scene_.set("evaluation", "range_m", std::nullopt, "0.5");
  const std::string before = read_file_bytes(file_);
  EXPECT_EQ(scene_.save(folder_.path(), "new.yaml"), folder_ / "new.yaml");
  EXPECT_EQ(read_scene(folder_ / "new.yaml").evaluation.distance.range_m, 0.5);
  EXPECT_EQ(read_file_bytes(file_), before);
}

TEST_F(ChangedSceneTest, CarriesThePartsThatAreTaken) {
  AttachedParts parts;
  for (const char* name : {"tool", "person"}) {
    AttachedPart& part = parts.parts.emplace_back();
    part.name = name;
    part.link = "arm_link_7";
    part.mesh_L = make_sphere(0.05);
    part.is_taken = true;
  }
  parts.parts.back().is_taken = false;
  scene_.add({}, parts);
  ASSERT_EQ(scene_.carried().size(), 1U);
  EXPECT_EQ(scene_.carried()[0].name, "tool");
  scene_.save(folder_.path(), "new.yaml");
  const SceneFile saved = read_scene(folder_ / "new.yaml");
  ASSERT_EQ(saved.attached.size(), 1U);
  EXPECT_EQ(saved.attached[0].name, "tool");
  EXPECT_EQ(saved.attached[0].mesh, folder_ / "new.attached.tool.stl");
  EXPECT_TRUE(fs::exists(folder_ / "new.attached.tool.stl"));

  folder_.write("other.attached.tool.stl", "mine");
  expect_parts(error_message([&] { scene_.save(folder_.path(), "other.yaml"); }),
               {"other.attached.tool.stl", "is there already", "expected a new name"});
  EXPECT_FALSE(fs::exists(folder_ / "other.yaml"));
  scene_.reset();
  EXPECT_TRUE(scene_.carried().empty());
}

TEST_F(ChangedSceneTest, SavesNowhereElse) {
  fs::create_symlink(folder_ / "nowhere.yaml", folder_ / "link.yaml");
  const auto before = folder_.names();
  const auto refused = [&](const std::string& name) {
    return error_message([&] { scene_.save(folder_.path(), name); });
  };
  for (const char* name : {"", ".yaml", "../new.yaml", "/tmp/new.yaml", "a/new.yaml", "new.yml",
                           "new", ".new.yaml", "n ew.yaml", "new.yaml\n"}) {
    expect_parts(refused(name), {"no name for a scene", "expected letters"});
  }
  expect_parts(refused(std::string(200, 'a') + ".yaml"), {"no name for a scene"});
  for (const char* name : {"scene.yaml", "one_camera.yaml", "link.yaml"}) {
    expect_parts(refused(name), {name, "is there already", "expected a new name"});
  }
  EXPECT_EQ(folder_.names(), before);
}

TEST_F(ChangedSceneTest, AFileThatChangedMeanwhileIsRefused) {
  folder_.write("scene.yaml", read_file_bytes(file_) + "\n# mine\n");
  expect_parts(error_message([&] { scene_.set("evaluation", "range_m", std::nullopt, "0.5"); }),
               {"scene.yaml", "has changed since it was opened"});
}

}  // namespace
}  // namespace berth::app
