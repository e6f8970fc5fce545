// Inside pipeline/ only: what Asker does with method `mesh`.
#pragma once

#include <memory>
#include <vector>

#include "berth/distance/mesh/mesh_distances.hpp"
#include "berth/pipeline/answer.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/visibility/whole_robot.hpp"

namespace berth {

/// One for each thread.
class MeshAsker {
 public:
  explicit MeshAsker(std::shared_ptr<const Robot> robot);

  /// Writes distances and visibility of `out` for the robot in this pose. At least one
  /// frame is used.
  void ask(const FrameSet& frames, const RobotPose& pose, Answer& out);

  /// Distances alone, of one pose of many.
  void ask(const FrameSet& frames, const RobotPose& pose, std::vector<WholeLinkDistance>& out);

  /// As Asker::forget().
  void forget();

 private:
  void tell_distances(const FrameSet& frames, LinkDistances& out) const;
  void tell_mean_directions(const FrameSet& frames, LinkDistances& out);
  void tell_visibility(const FrameSet& frames, const RobotPose& pose, Answer& out);
  void tell_doubtful(const FrameSet& frames, const RobotPose& pose, Answer& out);

  std::shared_ptr<const Robot> robot_;
  MeshWorkspace workspace_;
  std::vector<WholeLinkDistance> found_;
  MeshWorkspace doubtful_workspace_;
  std::vector<WholeLinkDistance> doubtful_;
  std::vector<WholeRobotView> views_;
  std::vector<DirectionView> direction_views_;
};

}  // namespace berth
