#include "lab/filter/judged_recording.hpp"

#include <Eigen/Geometry>
#include <numbers>

#include "berth/render/robot_renderer.hpp"
#include "berth/scene/open_scene.hpp"
#include "sim/random.hpp"

namespace berth::lab {
namespace {

Eigen::Vector3d random_direction(sim::Random& random) {
  Eigen::Vector3d direction{random.gaussian(), random.gaussian(), random.gaussian()};
  return direction.normalized();
}

/// What a calibration may be wrong by.
Pose random_error(sim::Random& random) {
  const Eigen::Vector3d axis = random_direction(random);
  const double angle_rad = random(0.2, 0.5) * std::numbers::pi / 180;
  const Eigen::Vector3d offset_m = random(0.002, 0.005) * random_direction(random);
  return Eigen::Translation3d(offset_m) * Eigen::AngleAxisd(angle_rad, axis);
}

/// One draw's calibration, the same for all frames.
struct Draw {
  Pose X_CC = Pose::Identity();
  std::vector<double> joints_rad;

  Draw(int seed, std::size_t joints) : joints_rad(joints, 0.0) {
    if (seed == 0) return;
    sim::Random random(static_cast<std::uint32_t>(seed));
    X_CC = random_error(random);
    for (double& joint_rad : joints_rad) joint_rad = random(-0.1, 0.1) * std::numbers::pi / 180;
  }
};

}  // namespace

JudgedRecording load_recording(const std::filesystem::path& folder, int draws) {
  const OpenScene scene = open_scene(folder / "scene.yaml");
  const OpenCamera& camera = scene.cameras.front();
  const MountedCamera& mounted = *camera.mounted;
  const RobotModel& model = mounted.robot()->model();
  const ExpectedRanges ranges = read_expected_ranges(folder / "expected.tsv");
  const std::vector<std::string> names = model.evaluated_link_names();
  RobotRenderer renderer(mounted.robot()->meshes(), mounted.camera());
  JudgedRecording recording{folder.filename().string(), {}};
  for (int seed = draws == 0 ? 0 : 1; seed <= draws; ++seed) {
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      std::vector<double> position = camera.at_exposure[i].position;
      const Draw draw(seed, position.size());
      for (std::size_t k = 0; k < position.size(); ++k) position[k] += draw.joints_rad[k];
      RobotPose pose;
      forward_kinematics(model, position, pose);
      JudgedView judged{mounted.camera(), camera.read_depth(i), {}, model.link_count(), {}};
      renderer.render(pose, mounted.camera_pose(pose) * draw.X_CC, judged.robot);
      for (const std::string& name : names) {
        judged.expected.push_back(ranges.at({static_cast<int>(i), name}));
      }
      recording.views.push_back(std::move(judged));
    }
  }
  return recording;
}

}  // namespace berth::lab
