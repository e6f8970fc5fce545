#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/types/whole_link_distance.hpp"

namespace berth {

/// What a robot would come near to on its way.
struct TrajectoryAnswer {
  /// Unless its status is ok, there are no poses.
  Timeliness time;
  /// poses[i][k] is the link with the id k + 1 at the i-th joint angles asked for.
  std::vector<std::vector<WholeLinkDistance>> poses;
  /// The first pose at which some link may be nearer to what is seen or hidden than the limit: its
  /// lower bound is.
  std::optional<std::size_t> first_nearer;
};

/// Look-ahead with method `mesh`: many poses in one call, side by side on the threads that TBB has.
/// One for each thread that asks.
class TrajectoryAsker {
 public:
  /// Throws std::invalid_argument unless the robot's method is `mesh`.
  explicit TrajectoryAsker(std::shared_ptr<const Robot> robot);
  ~TrajectoryAsker();

  /// The distances along `joints` against what `frames` saw; the age of the frames is judged at
  /// now_s, as by Asker. Valid until the next question. Throws std::invalid_argument for wrong
  /// joints and a limit that is no length.
  const TrajectoryAnswer& ask(const FrameSet& frames, std::span<const JointState> joints,
                              double nearer_than_m, std::optional<double> now_s = {});

 private:
  struct Workers;

  std::shared_ptr<const Robot> robot_;
  std::vector<RobotPose> poses_;
  std::unique_ptr<Workers> workers_;
  TrajectoryAnswer answer_;
};

}  // namespace berth
