// A small scene on disk for the tests of the commands: a robot of two joints before a wall.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "tests/apps/berth_program.hpp"

namespace berth {

using Json = nlohmann::json;

/// The values in scene.yaml, of which a test replaces some.
struct SceneLines {
  std::string robot =
      "{urdf: arm.urdf, package_paths: {arm_parts: parts}, environment_links: [table]}";
  std::string name = "front";
  std::string info = "camera_info.yaml";
  std::string pose = "{parent: base, xyz: [0, -2, 0.3], rpy: [-1.5707963267948966, 0, 0]}";
  std::string depth = "[depth/000000.png, depth/000001.png, depth/000002.png]";
  std::string more_camera = "depth_scale: 0.001";
  std::string more_cameras = "";
  std::string joints = "joints.csv";
  /// As simple as it can be, so that a test knows each pixel's fate.
  std::string self_filter = "{padding_m: 0, flying_patch_radius_m: 0}";
  std::string evaluation = "{range_m: 2}";
  std::string more = "";

  std::string text() const;
};

struct Rectangle {
  PixelRect pixels;
  double depth_m = 0;
};

/// What the camera sees beside the robot: a wall and rectangles before it, each at one depth along
/// the optical axis. Where a rectangle stands it hides the robot.
struct Surroundings {
  double wall_m = 3;
  std::vector<Rectangle> rectangles = {{{48, 12, 56, 20}, 1.7}};
  /// Added to the robot's depth, as a bad calibration does.
  double robot_offset_m = 0;
};

/// The joints in the order shoulder, elbow; both turn about the base's y axis.
struct Positions {
  double shoulder_rad = 0;
  double elbow_rad = 0;
};

/// Of the scene's frames, 1 s apart.
inline constexpr std::array<Positions, 3> kPositions = {{{0, 0}, {0.5, 0.3}, {-0.4, 0.6}}};

/// A fresh folder with arm.urdf, its mesh, camera_info.yaml, joints.csv and three depth images. The
/// links with geometry are base, upper, lower, finger, plug (never to be seen) and table.
class CommandScene {
 public:
  CommandScene();

  SceneLines lines;
  Surroundings surroundings;

  std::filesystem::path folder() const { return folder_ / ""; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
  }
  void write_scene() const { write("scene.yaml", lines.text()); }
  /// All files and folders below the folder, sorted.
  std::vector<std::string> all_names() const;

  /// The depth images of kPositions for the surroundings as they are now.
  void write_images() const;
  void write_image(const std::string& name, const Positions& positions, const Pose& X_BC,
                   double depth_scale_m = 0.001) const;

  /// Runs berth there, scene.yaml written anew.
  Outcome berth(const std::vector<std::string>& arguments) const;
  /// The same for a command that has to succeed: its JSON, line by line.
  std::vector<Json> json(std::vector<std::string> arguments) const;
  /// `run` of the scene as it is.
  std::vector<Json> run() const { return json({"run", "scene.yaml"}); }

 private:
  TemporaryFolder folder_;
};

/// 64 x 48 pixels, in tests/apps/command_scene.cpp's camera_info.yaml.
Camera scene_camera();
/// camera_info.yaml with this camera matrix.
std::string camera_info_text(const std::string& matrix = "[60, 0, 31.5, 0, 60, 23.5, 0, 0, 1]");
/// The URDF with `more` before its end.
std::string arm_urdf(const std::string& more = "");
/// The pose that SceneLines::pose says.
Pose front_pose();
/// A turn about the base's y axis.
Pose turned_about_y(double angle_rad);

/// The link of this name in a frame's JSON; null where there is none.
Json link_of(const Json& frame, const std::string& name);

}  // namespace berth
