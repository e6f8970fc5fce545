// Inside record/ only: does once more what was recorded, in its order, in one thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/record/recorded_cell.hpp"
#include "berth/record/recorded_messages.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

class ReplayedCell {
 public:
  /// `cell` outlives it.
  explicit ReplayedCell(const RecordedCell& cell);

  /// Knows nothing any more of what was before.
  void begin(const RecordedBegin& begin);
  void set_background(std::size_t camera, DepthView depth_m);
  void observe(std::size_t camera, const RecordedExposure& exposure, DepthView depth_m);
  /// Throws std::runtime_error for a frame that was not observed.
  Result ask(const RecordedRequest& request);

 private:
  std::vector<std::shared_ptr<const Frame>> frames_of(const RecordedRequest& request);
  NewestFrames newest_of(const RecordedRequest& request,
                         const std::vector<std::shared_ptr<const Frame>>& frames);
  Separation update(const RecordedMotion& motion, const Result& result);

  const RecordedCell& cell_;
  std::vector<Observer> observers_;
  FramePool pool_;
  /// Of each camera, by number.
  std::vector<std::map<std::uint64_t, std::shared_ptr<const Frame>>> frames_;
  /// What the query was asked about last; it does not hold frames itself.
  std::vector<std::shared_ptr<const Frame>> asked_;
  std::shared_ptr<const PreparedSpace> prepared_;
  std::optional<Query> query_;
  std::optional<SeparationMonitor> monitor_;
};

}  // namespace berth
