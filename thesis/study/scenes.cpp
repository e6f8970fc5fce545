#include "thesis/study/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "berth/pipeline/observer.hpp"
#include "sim/drawn_scene.hpp"

namespace berth::lab {
namespace {

sim::ImagePair images_of(const Recording& recording, std::size_t frame_number) {
  const OpenCamera& camera = recording.camera();
  Frame frame;
  Observer(camera.mounted)
      .observe(camera.read_depth(frame_number), camera.at_exposure[frame_number], frame);
  return {camera.mounted->camera(), std::move(frame.robot), std::move(frame.obstacles.depth_m),
          camera.mounted->robot()->model().link_count()};
}

/// A folder may have any name; the journal's columns are apart by commas.
std::string as_one_column(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return c == ',' || c == '"' || std::iscntrl(c) != 0; }, ' ');
  return name;
}

sim::ImagePair worst_case_images() {
  constexpr int kLinks = 8;
  sim::ImagePair images = sim::empty_images(640, 480, kLinks);
  images.robot.depth_m = DepthImage(640, 480, 1.5f);
  images.obstacle_depth_m = DepthImage(640, 480, 1.0f);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      images.robot.link_id(u, v) = static_cast<LinkId>(1 + u * kLinks / 640);
    }
  }
  return images;
}

}  // namespace

std::string_view name_of(SceneKind kind) {
  switch (kind) {
    case SceneKind::bundled:
      return "bundled";
    case SceneKind::drawn:
      return "drawn";
    case SceneKind::recording:
      return "recording";
    case SceneKind::worst_case:
      return "worst_case";
  }
  return {};
}

StudyScene recorded_scene(std::shared_ptr<const Recording> recording, SceneKind kind) {
  const std::size_t middle = recording->sampled_frame(1, 2);
  return {as_one_column(fmt::format("{}; frame {}", recording->title, middle)), kind,
          [recording, middle] { return images_of(*recording, middle); }};
}

std::vector<StudyScene> drawn_scenes(const Recording& recording, std::uint32_t seed, int count,
                                     int width_px, int height_px) {
  const auto model =
      std::make_shared<const RobotModel>(recording.camera().mounted->robot()->model());
  const auto trees =
      std::make_shared<const std::vector<sim::MeshTree>>(sim::build_link_trees(*model));
  sim::DrawnSceneSettings settings;
  settings.width_px = width_px;
  settings.height_px = height_px;
  std::vector<StudyScene> scenes;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t own_seed = seed + static_cast<std::uint32_t>(i);
    scenes.push_back({fmt::format("Drawn scene {}", own_seed), SceneKind::drawn,
                      [model, trees, settings, own_seed] {
                        sim::DrawnScene drawn = sim::draw_scene(*model, *trees, settings, own_seed);
                        return sim::ImagePair{drawn.camera, std::move(drawn.robot),
                                              std::move(drawn.obstacle_depth_m),
                                              model->link_count()};
                      }});
  }
  return scenes;
}

StudyScene worst_case_scene() { return {"Worst case", SceneKind::worst_case, worst_case_images}; }

}  // namespace berth::lab
