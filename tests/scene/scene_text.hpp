#pragma once

#include <string>

#include "berth/scene/scene_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {

/// A whole scene in few lines, of which a test replaces one.
struct SceneText {
  std::string robot = "{urdf: r.urdf}";
  std::string name = "name: front";
  std::string info = "info: c.yaml";
  std::string pose = "pose: {parent: base, xyz: [1, 2, 3], quaternion_xyzw: [0, 0, 0, 1]}";
  std::string depth = "depth: [0.png, 1.png]";
  std::string more_camera = "depth_scale: 0.001";
  std::string end = "joints: j.csv";

  std::string text() const {
    return "robot: " + robot + "\ncameras:\n  - " + name + "\n    " + info + "\n    " + pose +
           "\n    " + depth + "\n    " + more_camera + "\n" + end + "\n";
  }
};

inline SceneText with(std::string SceneText::*line, const std::string& text) {
  SceneText scene;
  scene.*line = text;
  return scene;
}

inline SceneFile read_text(const SceneText& scene) {
  const TemporaryFolder folder;
  return read_scene(folder.write("scene.yaml", scene.text()));
}

}  // namespace berth
