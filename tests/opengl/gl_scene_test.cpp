// From the depth image to the distances on the GPU, on the bundled scene and two real recordings,
// against the CPU.
#include <fmt/format.h>

#include <algorithm>

#include "berth/scene/open_scene.hpp"
#include "berth/opengl/gl_observer.hpp"
#include "berth/pipeline/observer.hpp"
#include "tests/opengl/robot_difference.hpp"
#include "tests/support/data_folder.hpp"
#include "tests/support/gl_test.hpp"
#include "tests/support/view_with.hpp"

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
    file_ = (is_bundled ? std::filesystem::path(BERTH_SOURCE_DIR) / "data/bundled"
                        : data_folder() / "recordings" / GetParam()) /
            "scene.yaml";
    if (!std::filesystem::exists(file_))
      GTEST_SKIP() << "needs the recordings; BERTH_DATA names their folder";
    scene_ = open_scene(file_);
  }

  const OpenCamera& camera() const { return scene_.cameras.front(); }
  /// A few of the frames: software renders slowly.
  std::vector<std::size_t> frames() const { return {0, camera().source.depth.size() / 2}; }
  std::shared_ptr<const View> view_filtered(const SelfFilterSettings& self_filter) const {
    ViewSettings settings = camera().view->settings();
    settings.self_filter = self_filter;
    return testing::view_with(*camera().view, settings);
  }

  std::filesystem::path file_;
  OpenScene scene_;
};

TEST_P(GlSceneTest, FatesAreThoseOfTheCpuForTheSameRobot) {
  const std::shared_ptr<const View>& view = camera().view;
  const SelfFilterSettings& settings = view->settings().self_filter;
  GlUpload upload = upload_for(view->camera());
  const GlTexture sensor_depth_m = depth_texture_for(view->camera());
  GlFrame gl(view->camera());
  GlSelfFilter filter;
  Observer observer(view);
  Frame frame;
  ObstacleImage found;
  for (const std::size_t i : frames()) {
    const DepthImage depth_m = camera().read_depth(i);
    observer.observe(depth_m, camera().at_exposure[i], frame);
    upload.send(depth_m, sensor_depth_m);
    upload.send(frame.robot, gl.robot);
    filter.filter(view->camera(), sensor_depth_m, gl.robot, settings, gl.obstacles);
    read_back(gl.obstacles, found);
    EXPECT_EQ(differing_fates(found, frame.obstacles), 0) << "frame " << i;
    EXPECT_EQ(filter.count(), frame.obstacles.count) << "frame " << i;
  }
}

TEST_P(GlSceneTest, ImagesAndDistancesAreThoseOfTheCpuButAtEdges) {
  const std::shared_ptr<const View>& view = camera().view;
  GlObserver gl_observer(view);
  GlFrame gl(view->camera());
  Observer observer(view);
  Frame frame;
  RobotImage robot;
  ObstacleImage obstacles;
  EvaluateWorkspace workspace;
  SearchableDepth searchable;
  LinkDistances from_cpu;
  LinkDistances from_gpu;
  double largest_m = 0;
  for (const std::size_t i : frames()) {
    const DepthImage depth_m = camera().read_depth(i);
    observer.observe(depth_m, camera().at_exposure[i], frame);
    gl_observer.observe(depth_m, camera().at_exposure[i], gl);
    read_back(gl.robot, robot);
    read_back(gl.obstacles, obstacles);

    const RobotDifference d = difference(robot, frame.robot);
    const std::int64_t fates = differing_fates(obstacles, frame.obstacles);
    fmt::print("{} frame {}: {} robot pixels, {} differ at edges, {} elsewhere; {} fates differ\n",
               GetParam(), i, d.robot_pixels, d.at_edges, d.wrong.size(), fates);
    EXPECT_TRUE(d.wrong.empty()) << "frame " << i;
    EXPECT_LE(d.edge_share(), kMostAtEdges) << "frame " << i;
    EXPECT_LE(fates, kMostFates * depth_m.width() * depth_m.height()) << "frame " << i;

    const int links = view->robot()->model().link_count();
    const DistanceSettings& settings = view->robot()->settings().distance;
    evaluate(Method::exact, {view->camera(), frame.robot, links, frame.searchable, settings},
             workspace, from_cpu);
    searchable.build(obstacles.depth_m);
    evaluate(Method::exact, {view->camera(), robot, links, searchable, settings}, workspace,
             from_gpu);
