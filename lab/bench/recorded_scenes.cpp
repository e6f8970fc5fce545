#include "lab/bench/recorded_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "berth/pipeline/observer.hpp"

namespace berth::lab {
namespace {

std::shared_ptr<const LinkShapes> shapes_of(const RobotModel& model) {
  auto shapes = std::make_shared<LinkShapes>();
  for (const std::size_t link : model.evaluated_links) shapes->push_back(model.links[link].mesh_L);
  return shapes;
}

/// Frames of a recording as scenes, one after the other.
class Frames {
 public:
  explicit Frames(std::shared_ptr<const Recording> recording)
      : recording_(std::move(recording)),
        shapes_L_(shapes_of(recording_->camera().mounted->robot()->model())),
        observer_(recording_->camera().mounted) {}

  BenchScene operator()(std::size_t frame_number) {
    const OpenCamera& camera = recording_->camera();
    const RobotModel& model = camera.mounted->robot()->model();
    observer_.observe(camera.read_depth(frame_number), camera.at_exposure[frame_number], frame_);

    BenchScene scene;
    scene.camera = camera.mounted->camera();
    scene.robot = frame_.robot;
    scene.obstacle_depth_m = frame_.obstacles.depth_m;
    scene.link_count = model.link_count();
    scene.range_m = camera.mounted->robot()->settings().distance.range_m;
    scene.shapes_L = shapes_L_;
    const Pose X_CB = frame_.X_BC.inverse();
    for (const std::size_t link : model.evaluated_links) {
      scene.X_CL.push_back(X_CB * frame_.pose.X_BL[link]);
    }
    return scene;
  }

 private:
  std::shared_ptr<const Recording> recording_;
  std::shared_ptr<const LinkShapes> shapes_L_;
  Observer observer_;
  Frame frame_;
};

}  // namespace

SceneSet recorded_scenes(std::shared_ptr<const Recording> recording, int max_count) {
  const Camera& camera = recording->camera().mounted->camera();
  const int frames = recording->frame_count();
  const int count = std::min(frames, max_count);
  const auto make = std::make_shared<Frames>(recording);
  return {recording->title,
          fmt::format("{} of {} frames, {} x {}, {} links, range {} m, after the self filter.",
                      count, frames, camera.width_px, camera.height_px,
                      recording->camera().mounted->robot()->model().link_count(),
                      recording->camera().mounted->robot()->settings().distance.range_m),
          count,
          [make, recording, count](int i) { return (*make)(recording->sampled_frame(i, count)); }};
}

}  // namespace berth::lab
