#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "berth/record/monitor_loop.hpp"
#include "berth/scene/camera_frames.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/plausibility.hpp"

namespace berth {

/// One image of a scene, in the order of its results.
struct ImageStep {
  std::size_t camera;
  /// Its number among the images of its camera.
  std::size_t frame;
  double stamp_s;
  /// The number of its result, that of its stamp.
  std::size_t result;
  /// Whether it is the first image of that result.
  bool begins_result;
  /// How many steps its result knows: all up to the last one of its stamp.
  std::size_t known;
};

/// All of them in the order of their stamps.
std::vector<ImageStep> scene_steps(const OpenScene& scene);

class Recorder;

/// The images of a scene, one after another, through the whole pipeline: what the command, and
/// whoever else runs scenes, stands on.
///
///     SceneRun run(scene);
///     while (run.next()) {
///       if (run.begins_result()) use(run.ask());
///     }
///
/// The images of all cameras come in the order of their stamps, and each result is that of the
/// newest image of every camera.
///
/// No image of a camera that is implausible (find_implausible) is used.
class SceneRun {
 public:
  /// The scene has to outlive it. Learns the background of the cameras that ask for one and whose
  /// scene does not name it;
  /// `before_image` is called before each of these images. Throws std::runtime_error where the
  /// scene's settings do not go together, and where all cameras are implausible; it says why.
  explicit SceneRun(
      const OpenScene& scene, const std::function<void()>& before_image = [] {});
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
  /// camera. What needs all images before is
  /// what `found` says of the cameras' watch, which is a run's result of this step; without it
  /// every camera is taken to stand where it should. After this a run goes on by go_to() alone.
  void go_to(std::size_t step, const Result* found = nullptr);
  const std::vector<ImageStep>& steps() const { return steps_; }

  /// What was found of each camera before the first image.
  const std::vector<CameraPlausibility>& plausibility() const { return plausibility_; }
  /// The background that this camera began with; none where its settings ask for none.
  std::optional<DepthImage> background_m(std::size_t camera) const {
    return cameras_[camera].background_m();
  }

  /// Once this is asked to stop, a request that runs ends within milliseconds, cut short.
  void stop_with(std::stop_token stop) { stop_ = std::move(stop); }

  /// Each image, request and result is recorded as well; to be called before the first image. The
  /// recorder is one of the scene's robot, cameras and separation, and outlives the run.
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
  DepthView sensor_depth_m() const { return sensor_depth_m(step().camera); }
  /// It stays as it is for those who hold it.
  std::shared_ptr<const Frame> frame() const { return cameras_[step().camera].frame(); }
  /// The newest image of any camera; null where it has none yet.
  std::shared_ptr<const Frame> frame(std::size_t camera) const { return kept_[camera]; }
  /// Its number among the images of its camera.
  std::size_t frame_number(std::size_t camera) const { return *cameras_[camera].number(); }
  const DepthImage& sensor_depth_m(std::size_t camera) const { return cameras_[camera].depth_m(); }
  /// What the images leave of space.
  const FrameSet& frame_set() const { return loop_.frames(); }

 private:
  SceneRun(const OpenScene& scene, std::vector<CameraPlausibility> known, bool is_monitored);

  const ImageStep& step() const { return steps_[step_ - 1]; }
  void observe(std::size_t camera, std::size_t image);
  void keep_frames();
  /// Numbers and stamp as the scene has them.
  void tell_scene(Result& result);

  const OpenScene& scene_;
  std::vector<CameraPlausibility> plausibility_;
  std::vector<CameraFrames> cameras_;
  std::vector<ImageStep> steps_;
  /// How many of them were taken, and how many observed.
  std::size_t step_ = 0;
  std::size_t observed_ = 0;
  std::vector<std::shared_ptr<const Frame>> kept_;
  MonitorLoop loop_;
  std::stop_token stop_;
  /// Null: nothing is recorded.
  Recorder* recorder_ = nullptr;
  std::vector<double> velocity_;
};

}  // namespace berth
