// Inside pipeline/ only: many poses in one request.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/pipeline/robot.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// Side by side on the threads that TBB has.
class LookAheadSearch {
 public:
  explicit LookAheadSearch(std::shared_ptr<const Robot> robot);
  ~LookAheadSearch();

  /// At least one frame is used. Throws std::invalid_argument for wrong joints.
  void ask(const FrameSet& frames, std::span<const JointState> joints, double nearer_than_m,
           LookAhead& out);

 private:
  struct Workers;

  std::shared_ptr<const Robot> robot_;
  std::vector<RobotPose> poses_;
  std::unique_ptr<Workers> workers_;
};

}  // namespace berth
