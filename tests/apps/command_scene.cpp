#include "tests/apps/command_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "berth/files/png.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/primitives.hpp"

namespace berth {
namespace {

std::string box_stl(const Eigen::Vector3d& size_m, const Eigen::Vector3d& centre_m) {
  const TriangleMesh box = make_box(size_m);
  std::string text = "solid box\n";
  for (const auto& triangle : box.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const auto corner : triangle) {
      const Eigen::Vector3d p = box.vertices_m[corner].template cast<double>() + centre_m;
      text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid box\n";
}

std::string joints_csv() {
  std::string text = "time,shoulder,elbow\n";
  for (std::size_t row = 0; row < kPositions.size(); ++row) {
    text += fmt::format("{},{},{}\n", row, kPositions[row].shoulder_rad, kPositions[row].elbow_rad);
  }
  return text;
}

void put(const Rectangle& rectangle, DepthImage& depth_m) {
  for (int v = rectangle.pixels.v_begin; v < rectangle.pixels.v_end; ++v) {
    for (int u = rectangle.pixels.u_begin; u < rectangle.pixels.u_end; ++u) {
      depth_m(u, v) = static_cast<float>(rectangle.depth_m);
    }
  }
}

DepthImage see(const Surroundings& surroundings, const RobotImage& robot) {
  DepthImage depth_m(robot.depth_m.width(), robot.depth_m.height(),
                     static_cast<float>(surroundings.wall_m));
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (robot.link_id.pixels()[i] == kNoLink) continue;
    depth_m.pixels()[i] =
        robot.depth_m.pixels()[i] + static_cast<float>(surroundings.robot_offset_m);
  }
  for (const Rectangle& rectangle : surroundings.rectangles) put(rectangle, depth_m);
  return depth_m;
}

}  // namespace

std::string SceneLines::text() const {
  return fmt::format(
      "robot: {}\ncameras:\n  - name: {}\n    info: {}\n    pose: {}\n    depth: {}\n    {}\n{}"
      "joints: {}\nself_filter: {}\nevaluation: {}\n{}",
      robot, name, info, pose, depth, more_camera, more_cameras, joints, self_filter, evaluation,
      more);
}

Camera scene_camera() { return {64, 48, 60, 60, 31.5, 23.5}; }

std::string camera_info_text(const std::string& matrix) {
  return "image_width: 64\nimage_height: 48\ncamera_matrix: {rows: 3, cols: 3, data: " + matrix +
         "}\ndistortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n";
}

std::string arm_urdf(const std::string& more) {
  return R"(<robot name="arm">
<link name="base"><visual><origin xyz="0 0 -0.2"/><geometry><box size="0.3 0.3 0.2"/></geometry></visual></link>
<link name="upper">
  <visual><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.05" length="0.5"/></geometry></visual>
  <collision><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.1" length="0.5"/></geometry></collision></link>
<link name="lower"><visual><geometry><mesh filename="package://arm_parts/lower.stl"/></geometry></visual></link>
<link name="finger"><visual><origin xyz="0 0 0.05"/><geometry><box size="0.08 0.06 0.1"/></geometry></visual></link>
<link name="plug"><visual><origin xyz="0 0.3 -0.2"/><geometry><box size="0.05 0.05 0.05"/></geometry></visual></link>
<link name="table"><visual><origin xyz="0 0 -0.4"/><geometry><box size="2 1 0.05"/></geometry></visual></link>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
  <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.5"/>
  <axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<joint name="slide" type="prismatic"><parent link="lower"/><child link="finger"/><origin xyz="0 0 0.3"/>
  <axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>
  <mimic joint="elbow" multiplier="0.2" offset="0.1"/></joint>
<joint name="socket" type="fixed"><parent link="base"/><child link="plug"/></joint>
<joint name="screws" type="fixed"><parent link="base"/><child link="table"/></joint>
)" + more +
         "</robot>\n";
}

Pose turned_about_y(double angle_rad) {
  return Pose(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitY()));
}

Pose front_pose() {
  return Eigen::Translation3d(0, -2, 0.3) *
         Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX());
}

CommandScene::CommandScene() {
  write("arm.urdf", arm_urdf());
  write("parts/lower.stl", box_stl({0.08, 0.08, 0.3}, {0, 0, 0.15}));
  write("camera_info.yaml", camera_info_text());
  write("joints.csv", joints_csv());
  std::filesystem::create_directory(folder_ / "depth");
  write_images();
  write_scene();
}

std::vector<std::string> CommandScene::all_names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
    names.push_back(entry.path().lexically_relative(folder()).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void CommandScene::write_images() const {
  for (std::size_t frame = 0; frame < kPositions.size(); ++frame) {
    write_image(fmt::format("depth/{:06}.png", frame), kPositions[frame], front_pose());
  }
}

void CommandScene::write_image(const std::string& name, const Positions& positions,
                               const Pose& X_BC, double depth_scale_m) const {
  const RobotModel model = load_robot({folder_ / "arm.urdf", {{"arm_parts", folder_ / "parts"}}});
  RobotPose pose;
  forward_kinematics(model, {positions.shoulder_rad, positions.elbow_rad}, pose);
  RobotImage robot;
  RobotRenderer(build_link_meshes(model), scene_camera()).render(pose, X_BC, robot);
  write_depth_png(folder_ / name, see(surroundings, robot), depth_scale_m);
}

Outcome CommandScene::berth(const std::vector<std::string>& arguments) const {
  write_scene();
  return run_berth(folder(), arguments);
}

std::vector<Json> CommandScene::json(std::vector<std::string> arguments) const {
  arguments.insert(arguments.end(), {"--format", "json"});
  const Outcome outcome = berth(arguments);
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::vector<Json> frames;
  std::istringstream lines_of_json(outcome.out);
  for (std::string line; std::getline(lines_of_json, line);) frames.push_back(Json::parse(line));
  return frames;
}

Json link_of(const Json& frame, const std::string& name) {
  for (const Json& link : frame.at("links")) {
    if (link.at("link") == name) return link;
  }
  return {};
}

}  // namespace berth
