// A scene file with changes that are not written to it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "berth/calibration/attached_parts.hpp"
#include "berth/scene/rewrite_scene.hpp"
#include "berth/scene/scene_file.hpp"

namespace berth::app {

/// All changes are made through the scene's text, so that what holds for a file holds for them:
/// the same checks, the same messages.
class ChangedScene {
 public:
  /// Throws as read_scene does.
  explicit ChangedScene(const std::filesystem::path& file);

  /// As it stands in the file, and as it is now.
  const SceneFile& original() const { return original_; }
  const SceneFile& now() const { return now_; }
  /// What save() writes.
  const SceneChange& change() const { return change_; }
  /// What the robot carries besides what the file names.
  std::vector<Attachment> carried() const;

  // Each of these throws std::runtime_error with the setting, the value and what was expected, and
  // then leaves all as it was.

  /// A setting of one camera or, without its number, of all; of requests, for the groups
  /// `evaluation`, `time` and `separation`. Without a text it is as in the file again.
  void set(const std::string& group, const std::string& key, std::optional<std::size_t> camera,
           const std::optional<std::string>& text);
  /// Without a pose it is as in the file again.
  void set_pose(std::size_t camera, const std::optional<Pose>& X_PC);
  /// Puts these changes over those that are there, and those of the parts that are taken on the
  /// robot.
  void add(const SceneChange& change, const AttachedParts& parts = {});
  /// All as in the file again.
  void reset();

  /// Writes the scene with its changes to a new file of this name in `folder`, with the meshes of
  /// what is carried beside it, and returns its path. Throws for a name that is no plain one of a
  /// .yaml file, and where something of these names is there.
  std::filesystem::path save(const std::filesystem::path& folder, const std::string& name) const;

 private:
  SceneCameraChange& camera_change(SceneChange& change, std::size_t camera) const;
  void require_same_file() const;
  void take(SceneChange change);

  std::filesystem::path file_;
  std::string text_;
  YamlScalars scalars_;
  SceneFile original_;
  SceneFile now_;
  SceneChange change_;
  AttachedParts carried_;
};

}  // namespace berth::app
