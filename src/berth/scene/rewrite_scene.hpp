// A user's scene file with what calibration found written into it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "berth/files/yaml_edit.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// Whether both lead to one place, through symbolic links too; nothing has to be there. Both are
/// without "..", or as if it were taken away by the text alone.
bool is_same_path(const std::filesystem::path& a, const std::filesystem::path& b);

/// From one file's folder to another's.
class PathMove {
 public:
  PathMove(const std::filesystem::path& from_file, const std::filesystem::path& to_file);

  /// The same file, relative to the new folder; absolute where it was, or where symbolic links make
  /// ".." lead elsewhere under another name of that folder. As it is where the folder stays.
  std::filesystem::path path(const std::filesystem::path& path) const;
  /// The same for a pattern as glob_files() takes it.
  std::string pattern(const std::string& pattern) const;

 private:
  std::filesystem::path from_;
  std::filesystem::path to_;
  bool stays_;
};

/// New values of a camera's entry in a scene file; what is not set stays as it is.
struct SceneCameraChange {
  std::string camera;  ///< its name
  /// The pose of the optical frame C in the frame P of the link that the entry names.
  std::optional<Pose> X_PC;
  std::optional<double> clock_offset_s;
  std::optional<double> depth_scale_m;
  std::optional<double> depth_offset_m;
  /// Numbers in maps of the entry, such as {"self_filter", {{"tolerance_m", 0.03}}}.
  std::map<std::string, std::map<std::string, double>> maps;
  /// A file in the new scene's folder.
  std::optional<std::filesystem::path> background = std::nullopt;
};

/// Something more that the robot carries.
struct SceneAttachmentChange {
  std::string link;
  /// In the link's frame; a file in the new scene's folder.
  std::filesystem::path mesh;
  std::string name;
};

/// New values of a scene file.
struct SceneChange {
  std::vector<SceneCameraChange> cameras;
  /// rad or m, by the name of the joint; in place of a joint's old offset, not added to it.
  std::map<std::string, double> joint_offsets;
  /// Other values at their places in the file, such as {{"evaluation", "range_m"}, "0.8"}.
  YamlScalars values = {};
  /// The last one stands first in the new file, and all of them before those that the old one has.
  std::vector<SceneAttachmentChange> attached = {};
};

/// The text of `scene_file` with the changes, to be written to `new_file`, whose folder is there.
/// The user's text is edited in place: comments, order, line ends, and a pose's kind of rotation
/// stay. Paths lead from the new folder to the same files; one becomes absolute where symbolic
/// links leave no relative path that holds. The text was read again as a scene: its poses are the
/// given ones to 1e-9 (as coefficients of the matrix), its other new numbers exactly, all else is
/// as before. Throws std::runtime_error with file, place and what was expected where that cannot be
/// had, as with an alias that two cameras share, or where read_scene throws; std::invalid_argument
/// where no camera has that name.
std::string rewritten_scene(const std::filesystem::path& scene_file, const SceneChange& change,
                            const std::filesystem::path& new_file);

/// Writes rewritten_scene(...) to `new_file`, which is complete afterwards, or as it was before.
/// Throws as that does, and where `new_file` is `scene_file` or cannot be written.
void write_rewritten_scene(const std::filesystem::path& scene_file, const SceneChange& change,
                           const std::filesystem::path& new_file);

}  // namespace berth
