#pragma once

#include <memory>
#include <span>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

class FrameSet;
class LinkSearches;

/// The newest frame of each camera with all that a request would have to do first: what their ages
/// leave of free space, and how far a first search for each link got. Made in the images' thread;
/// then constant, for any number of Query. Holds its frames.
class PreparedSpace {
 public:
  /// Of `cameras` cameras (1 to kMostCameras), none of which has given a frame.
  PreparedSpace(std::shared_ptr<const Robot> robot, std::size_t cameras);
  ~PreparedSpace();
  PreparedSpace(const PreparedSpace&) = delete;
  PreparedSpace& operator=(const PreparedSpace&) = delete;

  /// Camera k's newest frame, or null, as for Query::ask; the newest of their stamps is taken for
  /// now. The first search is for the robot at `joints`; null: where it was at the newest exposure.
  /// Nobody may ask meanwhile. Reuses its memory. Throws std::invalid_argument for wrong
  /// joints.
  void prepare(std::span<const std::shared_ptr<const Frame>> frames, const JointState* joints);

  /// Searches on, for the robot at `joints` now: so that the next request has little left to do.
  /// As prepare().
  void search(const JointState& joints);

  std::span<const std::shared_ptr<const Frame>> frames() const { return frames_; }
  /// What prepare() and then search() were called with, so that the same space can be made again.
  /// The first one has no position where the robot was taken as it was at the newest exposure.
  std::span<const JointState> searched_for() const {
    return {searched_for_.data(), searches_made_};
  }

 private:
  friend class Query;

  void note_search(const JointState* joints);
  void search_at(const JointState& joints);

  std::shared_ptr<const Robot> robot_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::vector<const Frame*> asked_;
  std::unique_ptr<FrameSet> set_;
  std::unique_ptr<LinkSearches> searches_;
  RobotPose pose_;
  /// The first `searches_made_` of them count; the others keep their memory.
  std::vector<JointState> searched_for_;
  std::size_t searches_made_ = 0;
};

}  // namespace berth
