// Inside pipeline/ only: what a request finds out of each link.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <vector>

#include "berth/distance/known_distances.hpp"
#include "berth/distance/mean_directions.hpp"
#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/candidate_search.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/pair_gradient.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/visibility/whole_robot.hpp"

namespace berth {

/// One for each thread.
class LinkSearches {
 public:
  using Clock = std::chrono::steady_clock;

  explicit LinkSearches(std::shared_ptr<const Robot> robot);

  /// Writes the links of `out` for the robot in this pose. At least one frame is used. A deadline
  /// counts from `begin` and holds for all that is told. `stop` ends the search early.
  void ask(const FrameSet& frames, const RobotPose& pose, Clock::time_point begin,
           const std::stop_token& stop, Result& out);

  /// Distances alone, of one pose of many.
  void ask(const FrameSet& frames, const RobotPose& pose, const DistanceSettings& settings,
           std::vector<WholeLinkDistance>& out);

  /// As Query::forget().
  void forget();

  /// Searches for the robot in this pose to the end, for others to go on from.
  void prepare(const FrameSet& frames, const RobotPose& pose);
  /// The next request goes on where `prepared` ended.
  void go_on_from(const LinkSearches& prepared);

 private:
  void search(const FrameSet& frames, const RobotPose& pose, const MeshRequest& request,
              std::vector<WholeLinkDistance>& out);
  void add_undecided(const FrameSet& frames, const RobotPose& pose, MeshRequest request,
                     std::vector<WholeLinkDistance>& out);
  void search_candidates(const FrameSet& frames, const RobotPose& pose, MeshRequest& request);
  void tell_distances(const FrameSet& frames, const RobotPose& pose, Result& out) const;
  /// LinkResult::assumed_thinner_m of out.links[i].
  float assumed_thinner_m(const FrameSet& frames, const RobotPose& pose, std::size_t i) const;
  /// To what no camera has to see.
  void tell_known(const RobotPose& pose, Result& out);
  void tell_mean_directions(const FrameSet& frames, Result& out);
  void tell_visibility(const FrameSet& frames, const RobotPose& pose, Result& out);
  void tell_rejected(const FrameSet& frames, const RobotPose& pose, Result& out);
  void search_rejected(const FrameSet& frames, const RobotPose& pose);

  std::shared_ptr<const Robot> robot_;
  /// Of each evaluated link, the middle of the box around it in its frame L.
  std::vector<Eigen::Vector3d> middles_L_m_;
  /// The environment's links, and the box around each in its frame.
  std::vector<std::size_t> environment_;
  std::vector<Eigen::AlignedBox3d> environment_boxes_m_;
  KnownWorkspace known_workspace_;
  std::vector<KnownPair> known_;
  MeshWorkspace workspace_;
  std::vector<WholeLinkDistance> found_;
  /// None where each link has one pair alone.
  std::optional<CandidateSearch> candidates_;
  PairGradient gradient_;
  MeshWorkspace undecided_workspace_;
  std::vector<WholeLinkDistance> undecided_;
  MeshWorkspace rejected_workspace_;
  std::vector<WholeLinkDistance> rejected_;
  std::vector<SeeingCamera> views_;
  std::vector<DirectionCamera> direction_views_;
  std::vector<LinkVisibility> visibility_;
  /// How long what follows a search takes.
  double after_search_us_ = 0;
};

/// Side by side on the threads that TBB has.
class LookAheadSearch {
 public:
  explicit LookAheadSearch(std::shared_ptr<const Robot> robot);
  ~LookAheadSearch();

  /// LookAhead::poses. At least one frame is used. Throws std::invalid_argument for wrong joints.
  void ask(const FrameSet& frames, std::span<const JointState> joints,
           const DistanceSettings& settings, std::vector<std::vector<WholeLinkDistance>>& out);

 private:
  struct Workers;

  std::shared_ptr<const Robot> robot_;
  std::vector<RobotPose> poses_;
  std::unique_ptr<Workers> workers_;
};

}  // namespace berth
