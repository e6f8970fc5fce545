// The scene that the pages show: what they ask for is done here, one thing after another.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/view/calibration_run.hpp"
#include "apps/view/changed_scene.hpp"
#include "apps/view/page_message.hpp"
#include "apps/view/timeline_run.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {

/// A scene, its settings as they were changed, and the frame that is shown: the same for all pages.
/// A change shows on that frame first; the others follow in the background. What is said of the
/// frame is provisional until the run in the background has come there; then it is what that run
/// says, as in the curves.
///
/// A request is an object with `do`, and:
///
///     {"do": "show", "step": 17}
///     {"do": "set", "group": "self_filter", "key": "padding_m", "camera": 0, "value": 0.03}
///     {"do": "pose", "camera": 0, "xyz_m": [0, 0, 1], "rpy_rad": [0, 0, 0]}
///     {"do": "space", "on": true}
///     {"do": "save", "name": "mine.yaml"}
///     {"do": "answer_calibration_data", "part": "link_7_attached", "is_taken": true}
///     {"do": "reset"}, {"do": "calibration_data"}, {"do": "drop_calibration_data"}, {"do":
///     "take_calibration_data"}
///
/// Without `camera` a setting is that of all cameras; null in place of a value or a pose is what
/// the file says. What is refused is published (kind "notice") with the reason; a change that is
/// made, without any.
class ViewedScene {
 public:
  /// Opens the scene; `before_image` as for open_scene. Saves to `folder` alone. Throws as
  /// open_scene does.
  ViewedScene(
      const std::filesystem::path& file, std::filesystem::path folder, Publish publish,
      const std::function<void()>& before_image = [] {});
  ~ViewedScene();
  ViewedScene(const ViewedScene&) = delete;
  ViewedScene& operator=(const ViewedScene&) = delete;

  /// Does what a page asks for, later; returns at once. Of what waits, the newest step and the
  /// newest value of a setting replace earlier ones. From any thread.
  void receive(const std::string& request);

  /// Ends what it does for pages, so that nothing is half saved; what runs in the background goes
  /// on.
  void finish();

 private:
  using Request = nlohmann::ordered_json;

  void work();
  void carry_out(const Request& request);
  void change(const std::function<void(ChangedScene&)>& change);
  void set(const Request& request);
  void set_pose(const Request& request);
  /// What stays as it is while the robot carries the same.
  void publish_robot();
  void show(std::size_t step);
  /// Publishes the images that the pages have not.
  void publish_images();
  void show_space(bool is_on);
  void publish_space();
  std::size_t camera_in(const Request& request) const;
  void tell(bool is_refused, const std::string& text);

  std::filesystem::path folder_;
  Publish publish_;
  ChangedScene changed_;
  std::shared_ptr<const OpenScene> scene_;
  /// The same with what was learned of it, and its step on show.
  std::shared_ptr<const OpenScene> shown_scene_;
  std::unique_ptr<SceneRun> shown_;
  std::size_t step_ = 0;
  /// Exposure::number of the images that the pages have.
  std::vector<std::uint64_t> image_numbers_;
  bool has_space_ = false;
  int notices_ = 0;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Request> requests_;
  /// More is known of the step on show.
  bool has_news_ = false;
  bool is_ending_ = false;
  TimelineRun timeline_;
  CalibrationRun data_;
  std::thread thread_;
};

}  // namespace berth::app
