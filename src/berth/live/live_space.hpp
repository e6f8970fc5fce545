#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "berth/live/joint_intake.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/prepared_space.hpp"

namespace berth {

/// What became of the frames.
struct LiveSpaceCounts {
  std::int64_t prepared = 0;  ///< how many sets of frames were made ready
  double last_prepare_s = 0;  ///< how long it took for the newest set
  double most_prepare_s = 0;
  std::int64_t failed = 0;  ///< that an exception ended, so that the set before stays the newest
};

/// What all running cameras leave of space, made ready for requests by a thread of its own: a
/// request neither ages an image nor waits for one. Frames that come while it works are made ready
/// together, once, when it is done.
class LiveSpace {
 public:
  /// For 1 to kMostCameras cameras of this robot. `joints` outlives it.
  LiveSpace(std::shared_ptr<const Robot> robot, std::size_t cameras, const JointIntake& joints);
  /// Ends the thread.
  ~LiveSpace();
  LiveSpace(const LiveSpace&) = delete;
  LiveSpace& operator=(const LiveSpace&) = delete;

  /// Camera k's newest frame. From any thread, such as in LiveCamera::OnFrame; returns at once.
  void put(std::size_t camera, std::shared_ptr<const Frame> frame);

  /// For Request::frames. Never null: before the first one no camera has a frame. Constant, and
  /// kept for who holds it.
  std::shared_ptr<const PreparedSpace> newest() const;
  LiveSpaceCounts counts() const;

 private:
  void run(const std::stop_token& stop);
  /// Whether some are new; not so at the end.
  bool wait_for_frames(const std::stop_token& stop);
  void prepare(const std::vector<std::shared_ptr<const Frame>>& frames);

  std::shared_ptr<const Robot> robot_;
  const JointIntake& joints_;
  Pool<PreparedSpace> pool_;
  JointState asked_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  bool has_changed_ = false;
  std::shared_ptr<const PreparedSpace> newest_;
  LiveSpaceCounts counts_;
  /// The last member: the thread uses all the others.
  std::jthread thread_;
};

}  // namespace berth
