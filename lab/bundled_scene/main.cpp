// make_bundled_scene OUT_DIR: writes the bundled scene with its true distances, always the same.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <random>
#include <vector>

#include "lab/bundled_scene/output_files.hpp"
#include "lab/bundled_scene/scene.hpp"
#include "lab/bundled_scene/sensor.hpp"
#include "lab/bundled_scene/truth.hpp"

namespace berth::lab {
namespace {

constexpr std::uint32_t kSeed = 20150731;

void write_robot(const std::filesystem::path& folder, const Scene& scene) {
  make_folder(folder / "meshes");
  write_text(folder / "arm.urdf", arm_urdf());
  for (int i = 0; i < kArmLinks; ++i) {
    const std::string name = arm_link_name(i);
    write_stl(folder / "meshes" / (name + ".stl"), scene.arm[i], "berth " + name + ", metres");
  }
}

void write_frames(const std::filesystem::path& folder, const Scene& scene) {
  make_folder(folder / "depth");
  const Camera camera = scene_camera();
  const Pose X_TC = scene_camera_place().X_TC();
  const std::vector<double> stamps_s = frame_stamps_s();
  const TruthModels models = make_truth_models(scene);
  std::vector<TruthRow> truth;
  std::mt19937 random(kSeed);
  for (int k = 0; k < std::ssize(stamps_s); ++k) {
    const PosedScene posed = pose_scene(scene, stamps_s[k]);
    std::vector<PosedMesh> everything = posed.robot;
    everything.insert(everything.end(), posed.obstacles.begin(), posed.obstacles.end());
    const CleanView view = look(RayCaster(everything, X_TC), camera);
    write_png(folder / "depth" / fmt::format("{:06}.png", k), sense(view, random));
    const Image<SensorHit> robot_alone = RayCaster(posed.robot, X_TC).cast(camera);
    for (const TruthRow& row : measure_truth(k, posed, models, robot_alone)) truth.push_back(row);
  }
  write_text(folder / "truth.csv", truth_csv(truth));
}

void make_bundled_scene(const std::filesystem::path& folder) {
  const Scene scene = make_scene();
  write_robot(folder / "arm", scene);
  write_text(folder / "camera_info.yaml", camera_info_yaml(scene_camera()));
  write_text(folder / "scene.yaml", scene_yaml(scene_camera_place(), frame_stamps_s()));
  write_text(folder / "joints.csv", joints_csv(scene.rows));
  write_frames(folder, scene);
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  CLI::App app(
      "Writes berth's bundled scene: a robot arm, a person, depth images and true distances");
  std::filesystem::path folder;
  app.add_option("OUT_DIR", folder, "Folder for the files; made if it is not there")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    berth::lab::make_bundled_scene(folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_bundled_scene: {}\n", error.what());
    return 1;
  }
}
