// Inside record/ only: robot, cameras and all their settings, as a recording has them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/record/mcap_reader.hpp"
#include "berth/separation/settings.hpp"

namespace berth {

/// What a monitor was made of.
struct RecordedCell {
  std::shared_ptr<const Robot> robot;
  std::vector<std::shared_ptr<const MountedCamera>> cameras;
  /// None: nothing was monitored.
  std::optional<SeparationSettings> separation;
  /// The version that recorded.
  std::string version;
  /// Whether requests had a deadline. The robot here has one without end: what a deadline cut short
  /// cannot be found again.
  bool had_deadline = false;
};

/// The cell as files: `cell.json` has all settings, `robot.json` the tree of links, and each mesh
/// is a PLY file.
std::vector<mcap::Attachment> attachments_of(const RecordedCell& cell);

/// Made anew from these files, equal to the last bit. Throws std::runtime_error with file, place
/// and what was expected: a file that is missing, a setting outside of its domain.
RecordedCell read_cell(const mcap::FileReader& file);

}  // namespace berth
