// What the robot carries and its URDF does not have, found by how it moves.
#pragma once

#include <string>
#include <vector>

#include "berth/calibration/calibrate.hpp"
#include "berth/robot/attachment.hpp"

namespace berth {

/// A thing that moves with a link: a tool, a cable box.
struct AttachedPart {
  /// No link has it: LINK_attached, or with a number behind it.
  std::string name;
  /// The link that it is fixed to, and the thing in that link's frame L: closed, wound
  /// counterclockwise as seen from outside, wider than what was seen by padding_m on all sides.
  std::string link;
  TriangleMesh mesh_L;
  double padding_m = 0;
  /// The lengths of the mesh along the axes of L.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  /// Of its surface, what no image looks at: it is padded twice there, and may reach farther still.
  double hidden_share = 0;
  /// The number of different places of the room where it was seen.
  int places = 0;
  /// The images that show it: camera and CalibrationFrame::number.
  struct Sight {
    std::size_t camera = 0;
    int frame = 0;
    bool operator==(const Sight&) const = default;
  };
  std::vector<Sight> seen_in;
  /// Of all readings that come and go near the robot, and that the self filter leaves, the share
  /// that is its own.
  double explained_share = 0;
  /// Whether the user takes it for a part of the robot; nobody does by himself.
  bool is_taken = false;
};

/// The part on its link, as a link of its own.
Attachment attachment_of(const AttachedPart& part);

/// All that was found.
struct AttachedParts {
  /// Those that explain more come first.
  std::vector<AttachedPart> parts;
  /// Why nothing was looked for, as a sentence; empty: it was.
  std::string refused;
};

/// The number of poses in which the robot has to be seen.
inline constexpr std::size_t kLeastPosesForAttached = 5;

/// Looks for what moves along with a link, with cameras, clocks and joints as in `found`. A place
/// of a link's frame belongs to the link if readings lie there at two places of the room and more,
/// none of which is one that may always be taken, and no image ever sees it free. So nothing that
/// stands in the room is taken for a part: it was never seen free where it stands. Where most of
/// what comes and goes near the robot is no part's, all are refused: what moves on its own may fit
/// a link by chance. `pause` is called now and then; to stop, it throws.
AttachedParts find_attached_parts(
    const CalibrationData& calibration_data, const CalibrationResult& found,
    const std::function<void()>& pause = [] {});

}  // namespace berth
