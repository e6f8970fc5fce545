// Inside berth only: the images of one camera of a scene, made into frames.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

/// Images of a camera that follow each other.
struct ImageRun {
  std::size_t first;
  std::size_t count;
};

/// What a run of a scene learns a background from: no more images than this, or than eight times
/// background_frames where that is more.
inline constexpr std::size_t kMostToLearnFrom = 256;

/// All images of the camera, or of a long recording runs of them that lie evenly over it.
std::vector<ImageRun> images_to_learn_from(const OpenCamera& camera);

/// Calls learn(depth_m, frame) for each of these images, with what an Observer makes of it;
/// `before_image` is called before each.
void learn_background(const OpenCamera& camera, const std::vector<ImageRun>& runs,
                      const std::function<void()>& before_image,
                      const std::function<void(DepthView, const Frame&)>& learn);

/// The newest image of one camera of a scene, and the frame that was made of it.
class CameraFrames {
 public:
  /// The camera has to outlive it. Cameras whose images have the same size may share a pool: then
  /// one frame more than there are cameras is enough.
  CameraFrames(const OpenCamera& camera, const FramePool& pool);

  /// Where the camera's settings ask for a background: takes the one that the scene names, or
  /// learns it; `before_image` is called before each image that it learns from.
  void begin_background(const std::function<void()>& before_image);
  /// Takes the one that the scene names, if any.
  void begin_given_background();
  std::optional<DepthImage> background_m() const;

  void observe(std::size_t image);
  /// Has no image from then on.
  void forget() { number_.reset(); }
  /// Tells in the last frame and those after it what somebody else found out of whether the camera
  /// stands where it should; null: it does. Nothing waits for its own watch from then on.
  void tell_watch(const CameraWatch* found);
  /// Whatever its frames say from now on, the camera is implausible.
  void distrust() { is_distrusted_ = true; }

  /// The number of the newest image among those of its camera; none: there is no image.
  const std::optional<std::size_t>& number() const { return number_; }
  const DepthImage& depth_m() const { return depth_m_; }
  /// Nothing writes to it while somebody holds it; null where there is no image.
  std::shared_ptr<const Frame> frame() const { return number_ ? frame_ : nullptr; }

 private:
  void put_watch();

  const OpenCamera* camera_;
  Observer observer_;
  FramePool pool_;
  std::optional<std::size_t> number_;
  DepthImage depth_m_;
  std::shared_ptr<Frame> frame_;
  CameraWatch own_watch_;
  std::optional<CameraWatch> found_;
  bool is_told_ = false;
  bool is_distrusted_ = false;
};

}  // namespace berth
