// From the depth image to the distances on the GPU, on the bundled scene and two real recordings,
// against the CPU.
#include <fmt/format.h>

#include <algorithm>

#include "apps/berth/open_scene.hpp"
#include "berth/opengl/gl_robot_renderer.hpp"
#include "berth/opengl/gl_self_filter.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/robot/robot_region.hpp"
#include "testing/data_folder.hpp"
#include "testing/gl_test.hpp"
#include "tests/opengl/robot_difference.hpp"

namespace berth {
namespace {

/// Pixels of the robot image that differ, as a share of those that show the robot.
constexpr double kMostAtEdges = 0.003;
/// Pixels whose fate differs where each draws its own robot, as a share of the image.
constexpr double kMostFates = 2e-4;
/// A distance from the GPU's obstacles to the GPU's robot against that of the CPU, in pixels at the
/// robot's depth: a link's outermost pixel may be the next one.
constexpr double kDistanceError_px = 1.5;

/// A scene's first camera on the GPU.
struct GlScene {
  explicit GlScene(const Rig& rig)
      : camera(rig.camera()),
        upload(camera.width_px, camera.height_px),
        sensor_depth_m(GlPixel::depth_m, camera.width_px, camera.height_px),
        robot(camera.width_px, camera.height_px),
        region(camera.width_px, camera.height_px),
        obstacles(camera.width_px, camera.height_px),
        renderer(rig.model(), camera) {
    const double scale = rig.settings().self_filter.robot_region_scale;
    if (scale > 0) region_renderer.emplace(robot_region(rig.model(), scale), camera);
  }

  void observe(const Rig& rig, DepthView depth_m, const JointState& joints) {
    RobotPose pose;
    forward_kinematics(rig.model(), joints.position, pose);
    const Pose X_BC = rig.camera_pose(pose);
    upload.send(depth_m, sensor_depth_m);
    renderer.render(pose, X_BC, robot);
    if (!region_renderer) {
      filter.filter(camera, sensor_depth_m, robot, rig.settings().self_filter, obstacles);
      return;
    }
    region_renderer->render(pose, X_BC, region);
    filter.filter(camera, sensor_depth_m, robot, region.link_id, rig.settings().self_filter,
                  obstacles);
  }

  Camera camera;
  GlUpload upload;
  GlTexture sensor_depth_m;
  GlRobotImage robot;
  GlRobotImage region;
  GlObstacleImage obstacles;
  GlRobotRenderer renderer;
  std::optional<GlRobotRenderer> region_renderer;
  GlSelfFilter filter;
};

std::int64_t differing_fates(const ObstacleImage& gpu, const ObstacleImage& cpu) {
  std::int64_t differing = 0;
  for (std::size_t i = 0; i < cpu.fate.pixels().size(); ++i)
    differing += gpu.fate.pixels()[i] != cpu.fate.pixels()[i];
  return differing;
}

class GlSceneTest : public testing::GlTest, public ::testing::WithParamInterface<std::string> {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    const bool is_bundled = GetParam() == "bundled";
    file_ = (is_bundled ? std::filesystem::path(BERTH_SOURCE_DIR) / "data/bundled"
                        : data_folder() / "recordings" / GetParam()) /
            "scene.yaml";
    if (!std::filesystem::exists(file_))
      GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
    scene_ = open_scene(file_, {});
  }

  const OpenCamera& camera() const { return scene_.cameras.front(); }
  /// A few of the frames: software renders slowly.
  std::vector<std::size_t> frames() const { return {0, camera().source.depth.size() / 2}; }
  Rig rig_with(const SelfFilterSettings& self_filter) const {
    RigSettings settings = camera().rig->settings();
    settings.self_filter = self_filter;
    return {camera().rig->model(),
            {camera().rig->camera(), camera().source.parent_link, camera().source.X_PC},
            settings};
  }

  std::filesystem::path file_;
  OpenScene scene_;
};

TEST_P(GlSceneTest, FatesAreThoseOfTheCpuForTheSameRobot) {
  const Rig& rig = *camera().rig;
  GlScene gl(rig);
  Observer observer(rig);
  Frame frame;
  ObstacleImage found;
  for (const std::size_t i : frames()) {
    const DepthImage depth_m = camera().read_depth(i);
    observer.observe(depth_m, camera().at_exposure[i], frame);
    gl.upload.send(depth_m, gl.sensor_depth_m);
    gl.upload.send(frame.robot, gl.robot);
    gl.filter.filter(gl.camera, gl.sensor_depth_m, gl.robot, rig.settings().self_filter,
                     gl.obstacles);
    read_back(gl.obstacles, found);
    EXPECT_EQ(differing_fates(found, frame.obstacles), 0) << "frame " << i;
    EXPECT_EQ(gl.filter.count(), frame.obstacles.count) << "frame " << i;
  }
}

TEST_P(GlSceneTest, ImagesAndDistancesAreThoseOfTheCpuButAtEdges) {
  const Rig& rig = *camera().rig;
  GlScene gl(rig);
  Observer observer(rig);
  Frame frame;
  RobotImage robot;
  ObstacleImage obstacles;
  EvaluateWorkspace workspace;
  ObstacleTree tree;
  LinkDistances from_cpu;
  LinkDistances from_gpu;
  double largest_m = 0;
  for (const std::size_t i : frames()) {
    const DepthImage depth_m = camera().read_depth(i);
    observer.observe(depth_m, camera().at_exposure[i], frame);
    gl.observe(rig, depth_m, camera().at_exposure[i]);
    read_back(gl.robot, robot);
    read_back(gl.obstacles, obstacles);

    const RobotDifference d = difference(robot, frame.robot);
    const std::int64_t fates = differing_fates(obstacles, frame.obstacles);
    fmt::print("{} frame {}: {} robot pixels, {} differ at edges, {} elsewhere; {} fates differ\n",
               GetParam(), i, d.robot_pixels, d.at_edges, d.wrong.size(), fates);
    EXPECT_TRUE(d.wrong.empty()) << "frame " << i;
    EXPECT_LE(d.edge_share(), kMostAtEdges) << "frame " << i;
    EXPECT_LE(fates, kMostFates * depth_m.width() * depth_m.height()) << "frame " << i;

    const int links = rig.model().link_count();
    evaluate(Method::exact, rig.camera(), frame.robot, frame.obstacles.depth_m, frame.obstacle_tree,
             links, rig.settings().distance, workspace, from_cpu);
    build_obstacle_tree(obstacles.depth_m, tree);
    evaluate(Method::exact, rig.camera(), robot, obstacles.depth_m, tree, links,
             rig.settings().distance, workspace, from_gpu);
    for (int link = 0; link < links; ++link) {
      EXPECT_EQ(from_gpu.links[link].status, from_cpu.links[link].status);
      if (from_cpu.links[link].status != LinkStatus::ok) continue;
      const double error_m =
          std::abs(from_gpu.links[link].distance_m - from_cpu.links[link].distance_m);
      const double pixel_m = from_cpu.links[link].robot_point_C_m.z() / rig.camera().fx_px;
      EXPECT_LE(error_m, kDistanceError_px * pixel_m) << "frame " << i << ", link " << link + 1;
      largest_m = std::max(largest_m, error_m);
    }
  }
  fmt::print("{}: distances differ by at most {:.2e} m\n", GetParam(), largest_m);
}

TEST_P(GlSceneTest, OnePassFiltersAsTheRulesForSinglePixelsDo) {
  SelfFilterSettings settings = camera().rig->settings().self_filter;
  settings.padding_m = 0;
  settings.link_padding_m.clear();
  settings.dilation_px = 0;
  settings.edge_jump_m = 0;
  settings.island_radius_m = 0;
  const Rig rig = rig_with(settings);
  GlScene gl(rig);
  const GlTexture filtered(GlPixel::depth_m, gl.camera.width_px, gl.camera.height_px);
  const std::size_t i = frames()[1];
  gl.observe(rig, camera().read_depth(i), camera().at_exposure[i]);
  ObstacleImage by_rules;
  read_back(gl.obstacles, by_rules);
  RobotPose pose;
  forward_kinematics(rig.model(), camera().at_exposure[i].position, pose);
  gl.renderer.render_and_filter(pose, rig.camera_pose(pose), {}, gl.sensor_depth_m,
                                tolerance_of(settings), gl.robot, filtered);
  DepthImage in_pass;
  read_back(filtered, in_pass);
  int differ = 0;
  int removed = 0;
  for (std::size_t p = 0; p < in_pass.pixels().size(); ++p) {
    const float expected_m = by_rules.depth_m.pixels()[p];
    const float found_m = in_pass.pixels()[p];
    differ += std::isnan(expected_m) != std::isnan(found_m) ||
              (!std::isnan(expected_m) && expected_m != found_m);
    removed += by_rules.fate.pixels()[p] == PixelFate::robot;
  }
  EXPECT_EQ(differ, 0);
  EXPECT_GT(removed, 1000);

  // Enlarged, it removes more.
  gl.renderer.render_and_filter(pose, rig.camera_pose(pose), {1, 0.02}, gl.sensor_depth_m,
                                tolerance_of(settings), gl.robot, filtered);
  DepthImage padded;
  read_back(filtered, padded);
  const auto none = [](const DepthImage& image) {
    return std::count_if(image.pixels().begin(), image.pixels().end(),
                         [](float depth_m) { return std::isnan(depth_m); });
  };
  fmt::print("{}: one pass removes {} pixels, with 2 cm along the normals {} more\n", GetParam(),
             removed, none(padded) - none(in_pass));
  EXPECT_GT(none(padded), none(in_pass) + 100);
}

TEST_P(GlSceneTest, TheRobotShapedRegionIsThatOfTheCpuButAtEdges) {
  SelfFilterSettings settings = camera().rig->settings().self_filter;
  settings.robot_region_scale = 3;
  const Rig rig = rig_with(settings);
  GlScene gl(rig);
  Observer observer(rig);
  Frame frame;
  ObstacleImage obstacles;
  const std::size_t i = frames()[1];
  const DepthImage depth_m = camera().read_depth(i);
  observer.observe(depth_m, camera().at_exposure[i], frame);
  gl.observe(rig, depth_m, camera().at_exposure[i]);
  read_back(gl.obstacles, obstacles);
  const std::int64_t fates = differing_fates(obstacles, frame.obstacles);
  fmt::print("{}: {} pixels ignored, {} fates differ\n", GetParam(),
             frame.obstacles.count_of(PixelFate::outside_region), fates);
  EXPECT_GT(frame.obstacles.count_of(PixelFate::outside_region), 1000);
  EXPECT_LE(fates, kMostFates * depth_m.width() * depth_m.height());
}

INSTANTIATE_TEST_SUITE_P(Scenes, GlSceneTest,
                         ::testing::Values("bundled", "xarm7_realsense", "lbr_med7_zed2i"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace berth
