// Things that move with a link: a tool, a workpiece.
#pragma once

#include <string>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth {

/// A mesh that is fixed to a link. It is filtered out of the images with it.
struct Attachment {
  /// By which it is detached; unique among attachments.
  std::string name;
  std::string link;
  /// In its own frame A.
  TriangleMesh mesh_A;
  /// The pose of A in the link's frame L.
  Pose X_LA = Pose::Identity();
  /// Whether it is evaluated as a link of its own, of this name, or as a part of the link.
  bool is_link = false;
  /// Whether somebody may be hurt by it at any speed: then no contact is tolerable.
  bool is_sharp = false;
  /// Whether it bends: the mesh is where it may be. What is read there is rejected, as what a rule
  /// drops, and it is no link.
  bool is_soft = false;
  /// Links that it may touch, such as the table that it lies on: KnownPair leaves
  /// them out. For a link of its own.
  std::vector<std::string> may_touch = {};
};

/// The robot with the thing on it. A link of its own gets the next id, after all others. Throws
/// std::invalid_argument that names the attachment and what was expected: a link that there is not,
/// or that is ignored or environment, a mesh without triangles, or that reaches farther than 20 m
/// from its origin, a soft one that is not closed, a pose that is not finite, a name that a link
/// has already, a link to touch that there is not, or one for what is no link of its own.
RobotModel with_attachment(const RobotModel& model, const Attachment& attachment);

}  // namespace berth
