// Scenes that the tests of rewritten ones begin with.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "berth/scene/rewrite_scene.hpp"
#include "berth/scene/scene_file.hpp"
#include "tests/support/error_message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {

inline Pose some_pose() {
  return Eigen::Translation3d(0.25, -1.5, 0.1234567890123) *
         Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
}

inline SceneChange full_change(const std::string& camera) {
  SceneCameraChange one{camera, some_pose(), -0.0125, 0.001013, 0.004, {}};
  one.maps["self_filter"] = {{"tolerance_m", 0.03}, {"tolerance_per_m2", 2}};
  one.maps["sensor"] = {{"speckle_px", 20}};
  return {{one}, {{"joint_2", 0.004}}};
}

/// A camera with everything on its own lines, one with everything on one line, and their scene.
inline const std::string kBlockCamera =
    "  - name: a\n"
    "    info: c.yaml\n"
    "    pose: {parent: p, xyz: [0, 0, 0], rpy: [0, 0, 0]}\n"
    "    depth: [depth/0.png]\n";
inline const std::string kFlowCamera =
    "  - {name: b, info: c.yaml, pose: {parent: p, xyz: [0, 0, 0], quaternion_xyzw: [0, 0, 0, 1]}, "
    "depth: [depth/0.png]}\n";

inline std::string scene_of(const std::string& cameras,
                            const std::string& end = "joints: j.csv\n") {
  return "robot: {urdf: r.urdf}\ncameras:\n" + cameras + end;
}

inline SceneChange maps_change(const std::string& camera, const std::string& map,
                               const std::string& key, double value) {
  return {{{camera, {}, {}, {}, {}, {{map, {{key, value}}}}}}, {}};
}

inline SceneChange pose_change(const std::string& camera, const Pose& X_PC) {
  return {{{camera, X_PC, {}, {}, {}, {}}}, {}};
}

inline std::string with_windows_lines(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? "\r\n" : std::string(1, c);
  return result;
}

/// A scene file of a cell with what its patterns look for.
class RewrittenScene : public ::testing::Test {
 protected:
  RewrittenScene() {
    for (const char* image : {"0.png", "1.png"}) {
      folder_.write(std::string("cell/depth/") + image, "");
      folder_.write(std::string("data/") + image, "");
    }
    std::filesystem::create_directories(folder_ / "calibrated");
  }

  std::filesystem::path new_file() const { return folder_ / "calibrated/new.yaml"; }

  std::filesystem::path write(const std::string& text) const {
    return folder_.write("cell/scene.yaml", text);
  }

  /// For a file in the same folder.
  std::string rewritten(const std::string& text, const SceneChange& change) const {
    return rewritten_scene(write(text), change, folder_ / "cell/new.yaml");
  }

  SceneFile reread(const std::string& text, const SceneChange& change) const {
    return parse_scene(folder_ / "cell/new.yaml", rewritten(text, change));
  }

  void expect_refused(const std::string& text, const SceneChange& change,
                      const std::vector<std::string>& parts) const {
    SCOPED_TRACE(text);
    expect_parts(error_message([&] { rewritten(text, change); }), parts);
  }

  TemporaryFolder folder_;
};

}  // namespace berth
