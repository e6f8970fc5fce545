#include "tests/support/reader_inputs.hpp"

#include <array>

#include "berth/files/camera_info.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "berth/record/replay.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/scene/scene_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace berth {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// In a folder of its own, that goes with the process.
template <typename Read>
void read_as(const char* name, Bytes bytes, Read read) {
  const TemporaryFolder folder;
  read(folder.write(name, std::string(bytes.begin(), bytes.end())));
}

void read_png(Bytes bytes) {
  // The size of the seeds.
  const Camera camera{16, 12, 20, 20, 8, 6};
  read_as("depth.png", bytes, [&](const auto& file) { read_depth_png(file, camera, 0.001); });
  read_as("ids.png", bytes, [&](const auto& file) { read_link_ids_png(file, camera); });
}

void read_info(Bytes bytes) {
  read_as("camera_info.yaml", bytes, [](const auto& file) { read_camera_info(file); });
}

void read_scene_file(Bytes bytes) {
  read_as("scene.yaml", bytes, [](const auto& file) { read_scene(file); });
}

void read_joints(Bytes bytes) {
  read_as("joints.csv", bytes, [](const auto& file) { read_joints_csv(file); });
}

/// A robot that is accepted has to be usable.
void read_robot(Bytes bytes) {
  read_as("robot.urdf", bytes, [](const auto& file) {
    const RobotModel model = load_robot({.urdf = file});
    RobotPose pose;
    forward_kinematics(model, std::vector<double>(model.joints.size(), 0.1), pose);
  });
}

template <const char* const& name>
void read_mesh(Bytes bytes) {
  read_as(name, bytes, [](const auto& file) { read_mesh_file(file); });
}

void read_recording(Bytes bytes) {
  read_as("stop.mcap", bytes, [](const auto& file) {
    Replay replay(file);
    while (replay.next()) {
    }
  });
}

constexpr const char* kStl = "mesh.stl";
constexpr const char* kObj = "mesh.obj";
constexpr const char* kDae = "mesh.dae";

constexpr std::array<ReaderInput, 9> kInputs{{{"png", read_png},
                                              {"camera_info", read_info},
                                              {"scene", read_scene_file},
                                              {"joints_csv", read_joints},
                                              {"urdf", read_robot},
                                              {"stl", read_mesh<kStl>},
                                              {"obj", read_mesh<kObj>},
                                              {"dae", read_mesh<kDae>},
                                              {"recording", read_recording}}};

}  // namespace

std::span<const ReaderInput> reader_inputs() { return kInputs; }

}  // namespace berth
