// make_bundled_scene OUT_DIR: writes the bundled scene with its true distances, always the same.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <vector>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "lab/bundled_scene/output_files.hpp"
#include "lab/bundled_scene/scene.hpp"
#include "lab/bundled_scene/truth.hpp"
#include "sim/bundled_camera.hpp"
#include "sim/structured_light.hpp"

namespace berth::lab {
namespace {

void write_robot(const std::filesystem::path& folder, const Scene& scene) {
  make_folder(folder / "meshes");
  write_text(folder / "arm.urdf", arm_urdf());
  for (int i = 0; i < sim::kArmLinks; ++i) {
    const std::string name = sim::arm_link_name(i);
    write_stl(folder / "meshes" / (name + ".stl"), scene.arm[i], "berth " + name + ", metres");
  }
}

void write_depth(const std::filesystem::path& folder, const Scene& scene,
                 const sim::BundledCamera& camera) {
  make_folder(folder / camera.depth_folder);
  sim::Random random(camera.seed);
  for (int k = 0; k < std::ssize(camera.stamps_s); ++k) {
    const PosedScene posed = pose_scene(scene, camera.stamps_s[k]);
    std::vector<sim::PosedMesh> everything = posed.robot;
    everything.insert(everything.end(), posed.obstacles.begin(), posed.obstacles.end());
    const sim::RayCaster rays(everything, camera.place.X_TC(), camera.camera,
                              sim::EmbreeThreads::one);
    write_png(folder / camera.depth_folder / fmt::format("{:06}.png", k),
              sim::sense(sim::look(rays), random));
  }
}

// Of the frames of this camera.
void write_truth(const std::filesystem::path& folder, const Scene& scene,
                 const sim::BundledCamera& camera) {
  const TruthTrees trees = build_truth_trees(scene);
  std::vector<TruthRow> truth;
  for (int k = 0; k < std::ssize(camera.stamps_s); ++k) {
    const PosedScene posed = pose_scene(scene, camera.stamps_s[k]);
    const sim::RayCaster robot_alone(posed.robot, camera.place.X_TC(), camera.camera,
                                     sim::EmbreeThreads::one);
    for (const TruthRow& row : measure_truth(k, posed, trees, robot_alone.cast()))
      truth.push_back(row);
  }
  write_text(folder / "truth.csv", truth_csv(truth));
}

void make_bundled_scene(const std::filesystem::path& folder) {
  const Scene scene = make_scene();
  const std::vector<sim::BundledCamera> cameras = sim::bundled_cameras();
  write_robot(folder / "arm", scene);
  write_text(folder / "joints.csv", joints_csv(scene.rows));
  write_text(folder / "scene.yaml", scene_yaml(cameras, "range_m: 1.0"));
  write_text(folder / "one_camera.yaml", scene_yaml(std::span(cameras).first(1), "range_m: 1.0"));
  for (const sim::BundledCamera& camera : cameras) {
    write_text(folder / camera.info_file, camera_info_yaml(camera));
    write_depth(folder, scene, camera);
  }
  write_truth(folder, scene, cameras.front());
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App app(
      "Writes berth's bundled scene: a robot arm, a person, the depth images of three cameras and "
      "true distances");
  std::filesystem::path folder;
  app.add_option("OUT_DIR", folder, "Folder for the files; made if it is not there")->required();
  if (const auto status = berth::app::parse_command_line(app, argc, argv)) return *status;
  return berth::app::carry_out("make_bundled_scene", 0,
                               [&] { berth::lab::make_bundled_scene(folder); });
}
