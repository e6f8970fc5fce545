#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "berth/pipeline/query.hpp"
#include "berth/scene/backend.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/scene_steps.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

class FramePipeline;
class GlBackend;
class Recorder;

/// The images of a scene, one after another, through the whole pipeline: what the command, and
/// whoever else runs scenes, stands on.
///
///     SceneRun run(scene);
///     while (run.next()) {
///       if (run.begins_result()) use(run.ask());
///     }
///
/// With method `mesh` the images of all cameras come in the order of their stamps, and each result
/// is that of the newest image of every camera; with a method that compares images they come camera
/// by camera, and each result is that of one image.
///
/// No image of a camera that is implausible (find_implausible) is used.
class SceneRun {
 public:
  /// The scene has to outlive it. Learns the background of the cameras that ask for one and whose
  /// scene does not name it;
  /// `before_image` is called before each of these images. Throws std::runtime_error where the
  /// backend is not there or the scene's settings do not go with it, and where all cameras are
  /// implausible; it says why.
  explicit SceneRun(
      const OpenScene& scene, const BackendChoice& where = {},
      const std::function<void()>& before_image = [] {});
  /// For go_to() alone, without delay: no implausible camera is looked for, no background is
  /// learned, no watch is waited for, and nothing is monitored.
  struct SingleSteps {};
  SceneRun(const OpenScene& scene, SingleSteps);
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// Observes the next image, and all of other cameras that have its stamp; false where there is
  /// none.
  bool next();

  /// Observes what is known at this step, whatever was observed before: the newest image of each
  /// camera, and those before it that its means are taken over. What needs all images before is
  /// what `found` says of the cameras' watch, which is a run's result of this step; without it
  /// every camera is taken to stand where it should. After this a run goes on by go_to() alone.
  void go_to(std::size_t step, const Result* found = nullptr);
  const std::vector<ImageStep>& steps() const { return steps_; }

  /// What was found of each camera before the first image.
  const std::vector<CameraPlausibility>& plausibility() const { return plausibility_; }
  /// The background that this camera began with; none where its settings ask for none.
  std::optional<DepthImage> background_m(std::size_t camera) const;

  /// Once this is asked to stop, a request that runs ends within milliseconds, cut short. Only
  /// where one result is that of all cameras.
  void stop_with(std::stop_token stop) { stop_ = std::move(stop); }

  /// Each image, request and result is recorded as well; before the first image, and only where one
  /// result is that of all cameras. The recorder is one of the scene's robot, cameras and
  /// separation, and outlives the run. Throws std::invalid_argument where it is not.
  void record_with(Recorder& recorder);

  /// The rest is about that image. The result, asked so often, with the times of the requests where
  /// that is more than once.
  Result ask(int repeat = 0);
  /// Whether it is the first image of its result: images of one stamp have one.
  bool begins_result() const { return step().begins_result; }
  const OpenCamera& camera() const { return scene_.cameras[step().camera]; }
  std::size_t camera_number() const { return step().camera; }
  /// Its number among the images of its camera.
  std::size_t frame_number() const { return step().frame; }
  DepthView sensor_depth_m() const { return newest_[step().camera].depth_m; }
  /// The images in this program's memory; read back from the GPU at each call. It stays as it is
  /// for who holds it.
  std::shared_ptr<const Frame> frame();
  /// The newest image of any camera; null where it has none yet, and with methods that compare
  /// images those of the others.
  std::shared_ptr<const Frame> frame(std::size_t camera) const { return kept_[camera]; }
  /// Its number among the images of its camera.
  std::size_t frame_number(std::size_t camera) const { return *newest_[camera].number; }
  const DepthImage& sensor_depth_m(std::size_t camera) const { return newest_[camera].depth_m; }
  /// What the images leave of space; only where one result is that of all cameras.
  const FrameSet& frame_set() const { return query_->frames(); }

 private:
  SceneRun(const OpenScene& scene, const BackendChoice& where,
           std::vector<CameraPlausibility> known);

  /// One camera's newest image.
  struct Newest {
    std::optional<std::size_t> number;
    DepthImage depth_m;
  };

  const ImageStep& step() const { return steps_[step_ - 1]; }
  void make_pipelines(const BackendChoice& where);
  void make_monitors();
  void begin_background(std::size_t camera, const std::function<void()>& before_image);
  void observe(std::size_t camera, std::size_t frame);
  /// As if all images before it had been observed.
  void observe_alone(const ImageStep& step);
  void keep_frames();
  void tell_scene(Result& result);
  void monitor(Result& result);

  const OpenScene& scene_;
  std::vector<CameraPlausibility> plausibility_;
  std::unique_ptr<GlBackend> gl_;
  /// One for each camera.
  std::vector<std::unique_ptr<FramePipeline>> pipelines_;
  std::vector<Newest> newest_;
  std::vector<ImageStep> steps_;
  /// How many of them were taken, and how many observed.
  std::size_t step_ = 0;
  std::size_t observed_ = 0;
  std::vector<std::shared_ptr<const Frame>> kept_;
  /// Only where one result is that of all cameras.
  std::optional<Query> query_;
  std::stop_token stop_;
  /// Null: nothing is recorded.
  Recorder* recorder_ = nullptr;
  /// The step's result; `anew`: with nothing known of one before.
  std::function<const Result&(bool anew)> ask_;
  /// Where the scene asks for them, one for each camera; where cameras are joined the first serves.
  std::vector<SeparationMonitor> monitors_;
  std::vector<double> velocity_;
};

}  // namespace berth
