// From the depth image to the distances on the GPU, on the bundled scene and two real recordings,
// against the CPU.
#include <fmt/format.h>

#include <algorithm>

#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/mounted_with.hpp"
#include "tests/thesis/opengl/robot_difference.hpp"
#include "thesis/evaluate.hpp"
#include "thesis/opengl/gl_evaluate.hpp"
#include "thesis/opengl/gl_frame_images.hpp"
#include "thesis/opengl/gl_observer.hpp"
#include "thesis/opengl/gl_robot_renderer.hpp"
#include "thesis/opengl/gl_self_filter.hpp"

namespace berth {
namespace {

/// Pixels of the robot image that differ, as a share of those that show the robot.
constexpr double kMostAtEdges = 0.003;
/// Pixels whose fate differs where each draws its own robot, as a share of the image.
constexpr double kMostFates = 2e-4;
/// A distance from the GPU's obstacles to the GPU's robot against that of the CPU, in pixels at the
/// robot's depth: a link's outermost pixel may be the next one.
constexpr double kDistanceError_px = 1.5;

GlUpload upload_for(const Camera& camera) { return {camera.width_px, camera.height_px}; }

GlTexture depth_texture_for(const Camera& camera) {
  return {GlPixel::depth_m, camera.width_px, camera.height_px};
}

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
    file_ = is_bundled ? std::filesystem::path(BERTH_SOURCE_DIR) / "data/bundled/one_camera.yaml"
                       : data_folder() / "recordings" / GetParam() / "scene.yaml";
    if (!std::filesystem::exists(file_))
      GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
    scene_ = open_scene(file_);
    CameraSettings settings = camera().mounted->settings();
    // A rule for `mesh`, which is not on the GPU.
    settings.sensor.phantom_radius_m = 0;
    scene_.cameras.front().mounted = testing::mounted_with(*camera().mounted, settings);
  }

  const OpenCamera& camera() const { return scene_.cameras.front(); }
  /// One of the frames: software renders slowly.
  std::size_t frame_number() const { return camera().source.depth.size() / 2; }
  std::shared_ptr<const MountedCamera> view_filtered(const SelfFilterSettings& self_filter) const {
    CameraSettings settings = camera().mounted->settings();
    settings.self_filter = self_filter;
    return testing::mounted_with(*camera().mounted, settings);
  }

  std::filesystem::path file_;
  OpenScene scene_;
};

TEST_P(GlSceneTest, FatesAreThoseOfTheCpuForTheSameRobot) {
  const std::shared_ptr<const MountedCamera>& mounted = camera().mounted;
  const SelfFilterSettings& settings = mounted->settings().self_filter;
  GlUpload upload = upload_for(mounted->camera());
  const GlTexture sensor_depth_m = depth_texture_for(mounted->camera());
  GlFrame gl(mounted->camera());
  GlSelfFilter filter;
  Observer observer(mounted);
  Frame frame;
  ObstacleImage found;
  const std::size_t i = frame_number();
  const DepthImage depth_m = camera().read_depth(i);
  observer.observe(depth_m, camera().at_exposure[i], frame);
  upload.send(depth_m, sensor_depth_m);
  upload.send(frame.robot, gl.images->robot);
  filter.filter(mounted->camera(), sensor_depth_m, gl.images->robot, settings,
                gl.images->obstacles);
  read_back(gl.images->obstacles, found);
  EXPECT_EQ(differing_fates(found, frame.obstacles), 0) << "frame " << i;
  EXPECT_EQ(filter.count(), frame.obstacles.count) << "frame " << i;
}

TEST_P(GlSceneTest, ImagesAndDistancesAreThoseOfTheCpuButAtEdges) {
  const std::shared_ptr<const MountedCamera>& mounted = camera().mounted;
  GlObserver gl_observer(mounted);
  GlFrame gl(mounted->camera());
  Observer observer(mounted);
  Frame frame;
  RobotImage robot;
  ObstacleImage obstacles;
  EvaluateWorkspace workspace;
  SearchableDepth searchable;
  LinkDistances from_cpu;
  LinkDistances from_gpu;
  double largest_m = 0;
  const std::size_t i = frame_number();
  const DepthImage depth_m = camera().read_depth(i);
  observer.observe(depth_m, camera().at_exposure[i], frame);
  gl_observer.observe(depth_m, camera().at_exposure[i], gl);
  read_back(gl.images->robot, robot);
  read_back(gl.images->obstacles, obstacles);

  const RobotDifference d = difference(robot, frame.robot);
  const std::int64_t fates = differing_fates(obstacles, frame.obstacles);
  fmt::print("{} frame {}: {} robot pixels, {} differ at edges, {} elsewhere; {} fates differ\n",
             GetParam(), i, d.robot_pixels, d.at_edges, d.wrong.size(), fates);
  EXPECT_TRUE(d.wrong.empty()) << "frame " << i;
  EXPECT_LE(d.edge_share(), kMostAtEdges) << "frame " << i;
  EXPECT_LE(fates, kMostFates * depth_m.width() * depth_m.height()) << "frame " << i;

  const int links = mounted->robot()->model().link_count();
  ImageDistanceSettings settings;
  static_cast<DistanceSettings&>(settings) = mounted->robot()->settings().distance;
  searchable.build(frame.obstacles.depth_m);
  evaluate(Method::exact, {mounted->camera(), frame.robot, links, searchable, settings}, workspace,
           from_cpu);
  searchable.build(obstacles.depth_m);
  evaluate(Method::exact, {mounted->camera(), robot, links, searchable, settings}, workspace,
           from_gpu);
  for (int link = 0; link < links; ++link) {
    EXPECT_EQ(from_gpu.links[link].status, from_cpu.links[link].status);
    if (from_cpu.links[link].status != LinkStatus::ok) continue;
    const double error_m =
        std::abs(from_gpu.links[link].distance_m - from_cpu.links[link].distance_m);
    const double pixel_m = from_cpu.links[link].robot_point_C_m.z() / mounted->camera().fx_px;
    EXPECT_LE(error_m, kDistanceError_px * pixel_m) << "frame " << i << ", link " << link + 1;
    largest_m = std::max(largest_m, error_m);
  }
  fmt::print("{}: distances differ by at most {:.2e} m\n", GetParam(), largest_m);
}

TEST_P(GlSceneTest, OnePassFiltersAsTheRulesForSinglePixelsDo) {
  SelfFilterSettings settings = camera().mounted->settings().self_filter;
  settings.padding_m = 0;
  settings.link_padding_m.clear();
  settings.flying_patch_radius_m = 0;
  const auto mounted = view_filtered(settings);
  GlFrame gl(mounted->camera());
  const std::size_t i = frame_number();
  const DepthImage depth_m = camera().read_depth(i);
  GlObserver(mounted).observe(depth_m, camera().at_exposure[i], gl);
  ObstacleImage by_rules;
  read_back(gl.images->obstacles, by_rules);
  const GlTexture sensor_depth_m = depth_texture_for(mounted->camera());
  upload_for(mounted->camera()).send(depth_m, sensor_depth_m);
  const GlTexture filtered = depth_texture_for(mounted->camera());
  GlRobotRenderer renderer(mounted->robot()->model(), mounted->camera());
  renderer.render_and_filter(gl.pose, gl.X_BC, {}, sensor_depth_m, tolerance_of(settings),
                             gl.images->robot, filtered);
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
  renderer.render_and_filter(gl.pose, gl.X_BC, {1, 0.02}, sensor_depth_m, tolerance_of(settings),
                             gl.images->robot, filtered);
  DepthImage padded;
  read_back(filtered, padded);
  const auto none = [](const DepthImage& image) {
    return std::count_if(image.pixels().begin(), image.pixels().end(),
                         [](float z_m) { return std::isnan(z_m); });
  };
  fmt::print("{}: one pass removes {} pixels, with 2 cm along the normals {} more\n", GetParam(),
             removed, none(padded) - none(in_pass));
  EXPECT_GT(none(padded), none(in_pass) + 100);
}

TEST_P(GlSceneTest, TheRobotShapedRegionIsThatOfTheCpuButAtEdges) {
  SelfFilterSettings settings = camera().mounted->settings().self_filter;
  settings.robot_region_scale = 3;
  const auto mounted = view_filtered(settings);
  GlObserver gl_observer(mounted);
  GlFrame gl(mounted->camera());
  Observer observer(mounted);
  Frame frame;
  ObstacleImage obstacles;
  const std::size_t i = frame_number();
  const DepthImage depth_m = camera().read_depth(i);
  observer.observe(depth_m, camera().at_exposure[i], frame);
  gl_observer.observe(depth_m, camera().at_exposure[i], gl);
  read_back(gl.images->obstacles, obstacles);
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
