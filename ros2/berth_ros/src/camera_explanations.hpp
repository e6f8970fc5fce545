// Whether the cameras of a running robot see it where it should be, as far as no single image
// reports.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <sensor_msgs/msg/image.hpp>
#include <string>
#include <thread>
#include <vector>

#include "berth/live/joint_intake.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/scene/live_plausibility.hpp"
#include "node_settings.hpp"

namespace berth_ros {

/// What several images of one camera say.
struct CameraExplanation {
  /// Of the camera as it was then; null before the first look.
  std::shared_ptr<const berth::MountedCamera> mounted;
  /// A sentence that begins with the camera's name; empty where nothing is wrong.
  std::string text;
  /// There were enough of them to take the camera out; else they explain what single images told.
  bool is_sure = false;
  int looks = 0;
};

/// Keeps some images of each camera as the robot moves, and looks at them in a thread of its own,
/// of a low priority, that takes a thirtieth of a core.
class CameraExplanations {
 public:
  using FindJoints = std::function<std::shared_ptr<const berth::JointIntake>()>;
  /// Called in that thread for each camera once its images are looked at, with what newest()
  /// reports from then on.
  using OnLook = std::function<void(std::size_t camera, const CameraExplanation&)>;

  CameraExplanations(std::vector<CameraSettings> cameras, FindJoints find_joints, OnLook on_look);
  /// Ends the thread, within a second or so.
  ~CameraExplanations();
  CameraExplanations(const CameraExplanations&) = delete;
  CameraExplanations& operator=(const CameraExplanations&) = delete;

  /// A camera's frame, in its thread; returns at once. The message is kept for a moment.
  void put(std::size_t camera, const berth::Frame& frame,
           const std::shared_ptr<const sensor_msgs::msg::Image>& image);
  /// The robot is another one: nothing that was found holds.
  void forget();
  CameraExplanation newest(std::size_t camera) const;

 private:
  struct Taken {
    std::shared_ptr<const berth::MountedCamera> mounted;
    std::shared_ptr<const sensor_msgs::msg::Image> image;
    berth::JointState at_exposure;
  };
  struct Camera {
    bool is_wanted = false;
    std::optional<Taken> taken;
    /// Whether its last frame alone told that something is wrong.
    bool is_suspected = false;
    /// Its images are of another camera than those that were looked at.
    bool is_new = false;
    CameraExplanation newest;
    /// The thread's alone.
    berth::LiveImages kept;
  };
  struct Stopped {};

  void run();
  /// Throw Stopped.
  void stop_if_asked() const;
  void sleep(double seconds);
  /// After a look that took so long; ends early where there is a new camera.
  void rest(double took_s);
  void collect();
  /// What comes within a moment, by camera.
  std::vector<std::optional<Taken>> take_images();
  void keep(std::size_t camera, const Taken& taken);
  bool is_any_full() const;
  bool has_moved(const std::vector<double>& positions) const;
  bool is_any(bool Camera::*what) const;
  void look();
  void tell_failure(const std::string& what);
  /// None where nothing is to be told of it.
  std::optional<CameraExplanation> take(std::size_t camera, const berth::CameraPlausibility& found,
                                        std::int64_t forgotten);

  std::vector<CameraSettings> settings_;
  FindJoints find_joints_;
  OnLook on_look_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool is_stopped_ = false;
  std::int64_t forgotten_ = 0;
  std::vector<Camera> cameras_;
  /// The thread's alone.
  std::vector<double> last_positions_;
  std::thread thread_;
};

}  // namespace berth_ros
